// A step must not ask for memory.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "sim/multibody/hht.h"
#include "sim/multibody/joint_drive.h"
#include "tests/sim/mechanism.h"

using namespace stillhook;
using truth::GeneralMotion;
using Type = JointSpec::Type;

// Counts every request for memory of this program; glibc's own functions do the work. Not under a sanitizer, which has
// its own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
namespace {
long requests = 0;
}
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++requests;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++requests;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++requests;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++requests;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++requests;
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? 12 : 0;
}
}

TEST_CASE("hht: a step asks for no memory, whether it keeps or renews its factorisation") {
  // As many bodies and joints as a crane has, so that every size at which Eigen changes its way is passed.
  GeneralMotion draw(10);
  Mechanism m;
  for (int i = 0; i < 7; ++i)
    m.add_body(std::string(1, 'b'), 2.0, general_inertia(draw, 1.0), draw.body(3.0, 0.0, 0.0));
  const Type types[] = {Type::revolute, Type::prismatic, Type::fixed, Type::spherical};
  for (int i = 0; i < 4; ++i)
    m.add_joint(std::string(1, 'j'), types[i], i, i + 1, m.state.body[i].p_WC + draw.vector(0.5), draw.unit());
  for (int i = 0; i < 7; ++i)
    m.system.elements.push_back(std::make_unique<LineSpring>(std::string("s"), BodyPoint{i, draw.vector(0.5)},
                                                             BodyPoint{kWorld, draw.vector(6.0)}, 50.0, 1.0, 3.0));
  m.system.elements.push_back(std::make_unique<JointDrive>(std::string("d"), m.system.joints[0], 10.0, 1.0, 0.1, -1));
  m.system.elements.push_back(std::make_unique<JointDrive>(std::string("e"), m.system.joints[1], 10.0, 1.0, 0.1, -1));
  m.finish();
  HhtStepper stepper(m.system, {});
  REQUIRE(stepper.step(m.state, 0.01, m.state.drive));
  REQUIRE(stepper.step(m.state, 0.01, m.state.drive));
  const long factorised = stepper.factorisations();
  const long before = requests;
  bool all = true;
  for (int k = 0; k < 50; ++k) all = stepper.step(m.state, k % 10 == 9 ? 0.005 : 0.01, m.state.drive) && all;
  const long during = requests - before;
  CHECK(all);
  CHECK(during == 0);
  CHECK(stepper.factorisations() > factorised);  // both ways were gone
  {
    const long mark = requests;
    std::vector<double> counted(1000);
    CHECK(counted.size() == 1000);
    CHECK(requests > mark);  // the counter counts
  }
}
#endif
