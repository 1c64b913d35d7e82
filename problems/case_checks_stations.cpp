// Vessels that move by displacement RAOs, and what cannot be with them.
#include <fmt/core.h>

#include <algorithm>

#include "problems/case_checks.h"
#include "problems/case_key.h"

namespace stillhook {
namespace {

class StationCheck {
 public:
  StationCheck(const Case& c, const Node& root, Findings& findings)
      : spec_(c.specification), root_(root), findings_(findings) {}

  void run() {
    for (const BodySpec& body : spec_.bodies)
      if (body.moved_by_sea()) check_moved_by_sea(body);
  }

 private:
  void report(const std::string& entry, const std::string& key, const std::string& sentence) {
    findings_.add(position_of_key(root_, entry, key), entry, key, sentence);
  }
  bool written(const std::string& entry, const std::string& key) const {
    return find_key(root_, entry, key) != nullptr;
  }

  void check_moved_by_sea(const BodySpec& body) {
    const std::string entry = "bodies." + body.name, water = entry + ".hydrodynamics";
    if (body.name == spec_.operation.load)
      report(water, "kind", "\"rao\" cannot move the load of the operation: it has to follow its wires");
    for (const char* key : {"velocity_m_per_s", "angular_velocity_deg_per_s"})
      if (written(entry, key)) report(entry, key, "has no meaning with kind = \"rao\": the sea alone moves the body");
    for (const char* key : {"linear_damping_kN_s_per_m", "linear_angular_damping_kN_m_s_per_rad",
                            "quadratic_damping_kN_s2_per_m2", "quadratic_angular_damping_kN_m_s2_per_rad2",
                            "critical_fraction_heave", "critical_fraction_roll", "critical_fraction_pitch"})
      if (written(water, key))
        report(water, key, "has no meaning with kind = \"rao\": the RAOs are what damping left of the motion");
    check_joints_of(body);
    if (!(spec_.solver.hht_alpha < 0.0))
      report("solver", "hht_alpha",
             fmt::format("must be < 0 with a body that moves by RAOs, whose reactions ring without numerical damping, "
                         "got {:.6g}",
                         spec_.solver.hht_alpha));
  }

  /// A chain of joints from a body that the sea moves may not come to the world or to another such body.
  void check_joints_of(const BodySpec& body) {
    std::vector<std::string> reached = {body.name};
    for (std::size_t n = 0; n < reached.size(); ++n)
      for (const JointSpec& joint : spec_.joints) {
        const bool parent = joint.parent == reached[n], child = joint.child == reached[n];
        if (!parent && !child) continue;
        const std::string& other = parent ? joint.child : joint.parent;
        const bool free = joint.type != JointSpec::Type::fixed;
        if (other == "world" || is_moved_by_sea(other, body.name)) {
          report("joints." + joint.name, parent ? "child" : "parent",
                 fmt::format("ties \"{}\", which moves by RAOs alone, to \"{}\", which does not follow it{}", body.name,
                             other, free ? "; use wires or contacts between them" : ": fix it to one of them"));
          continue;
        }
        if (std::find(reached.begin(), reached.end(), other) == reached.end()) reached.push_back(other);
      }
  }
  bool is_moved_by_sea(const std::string& name, const std::string& but) const {
    return name != but && std::any_of(spec_.bodies.begin(), spec_.bodies.end(),
                                      [&](const BodySpec& b) { return b.name == name && b.moved_by_sea(); });
  }

  const Specification& spec_;
  const Node& root_;
  Findings& findings_;
};

}  // namespace

void check_stations(const Case& c, const Node& root, Findings& findings) { StationCheck(c, root, findings).run(); }

}  // namespace stillhook
