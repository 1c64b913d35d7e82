#include "sim/multibody/assembly.h"

namespace stillhook {

std::vector<bool> jointed_to(const MultibodySystem& system, int body) {
  std::vector<bool> jointed(system.bodies.size(), false);
  jointed[body] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (const Joint& j : system.joints) {
      const int p = j.on_parent.body, c = j.on_child.body;
      if (p == kWorld || jointed[p] == jointed[c]) continue;
      jointed[p] = jointed[c] = grown = true;
    }
  }
  return jointed;
}

}  // namespace stillhook
