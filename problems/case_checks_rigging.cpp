// Rigging in a case: its keys, its rules, and the bodies and wires that it stands for.
#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "problems/case_checks.h"
#include "problems/case_format.h"
#include "problems/case_key.h"
#include "problems/entry_check.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kMostStretch = 0.03;   // of its length: a steel wire parts before that
constexpr double kRestingShare = 1e-6;  // of the mean tension: less is slack

void add_sling_keys(TableOf<SlingSpec>& t) {
  using S = SlingSpec;
  t.name("name", &S::name, "Name of the sling, a wire.");
  t.number("length_m", &S::length, unit::m, positive(), "Length without load, eye to eye.").require();
  t.number("length_error_mm", &S::length_error, unit::mm, any_value(),
           "By which it is longer than that; negative: shorter.");
  t.number("axial_stiffness_kN", &S::axial_stiffness, unit::kN, positive(), "EA.").require();
  t.number("damping_ratio", &S::damping_ratio, unit::one, between(0.0, 1.0),
           "Damping as a share of critical, of the load over the number of slings.");
  t.number("breaking_load_kN", &S::breaking_load, unit::kN, positive(), "Minimum breaking load.").absent("not given");
}

const Table& sling_table() {
  static const Table table = [] {
    TableOf<SlingSpec> t("rigging.slings",
                         "A sling to the load: from the hook, or from the spreader where there is one.");
    t.vector("to_m", &SlingSpec::to, unit::m, any_value(), "Its lower end in the frame of the load.").require();
    t.vector("from_m", &SlingSpec::from, unit::m, any_value(), "Its upper end in the frame of the spreader.")
        .absent("the hook; needed with a spreader");
    add_sling_keys(t);
    return t.build();
  }();
  return table;
}

const Table& upper_sling_table() {
  static const Table table = [] {
    TableOf<SlingSpec> t("rigging.spreader.slings", "A sling from the hook to the spreader.");
    t.vector("to_m", &SlingSpec::to, unit::m, any_value(), "Its lower end in the frame of the spreader.").require();
    add_sling_keys(t);
    return t.build();
  }();
  return table;
}

const Table& spreader_table() {
  static const Table table = [] {
    using S = SpreaderSpec;
    TableOf<S> t("rigging.spreader", "A spreader bar or frame between the hook and the load: a body.");
    t.name("name", &S::name, "Name of its body.");
    t.number("mass_t", &S::mass, unit::t, positive(), "Mass.").require();
    t.vector("size_m", &S::size, unit::m, positive(),
             "Length, breadth and depth of the box that its inertia is that of.")
        .require();
    t.vector("cog_m", &S::cog, unit::m, any_value(), "Centre of gravity in its frame.");
    t.tables("slings", &S::slings, "name", &upper_sling_table, "Slings from the hook.").require();
    return t.build();
  }();
  return table;
}

/// What is wrong with one entry beyond its keys.
class RiggingCheck {
 public:
  RiggingCheck(const RiggingSpec& rigging, const Specification& spec, const Node& root, Findings& findings)
      : rigging_(rigging), spec_(spec), root_(root), findings_(findings), entry_("rigging." + rigging.name) {}

  /// True if bodies and wires can be made of it.
  bool counts() {
    if (!entry_named(spec_.bodies, rigging_.load)) {
      std::vector<std::string> bodies;
      for (const BodySpec& body : spec_.bodies) bodies.push_back(body.name);
      report(entry_, "load",
             fmt::format("there is no body \"{}\"{}", rigging_.load, did_you_mean(rigging_.load, bodies)));
      return false;
    }
    const bool spreader = !rigging_.spreader.name.empty();
    few(rigging_.slings, entry_, "slings");
    lengths(rigging_.slings, entry_ + ".slings.");
    if (spreader) {
      few(rigging_.spreader.slings, entry_ + ".spreader", "slings");
      lengths(rigging_.spreader.slings, entry_ + ".spreader.slings.");
    }
    for (const SlingSpec& s : rigging_.slings)
      if (const std::string at = entry_ + ".slings." + s.name; spreader != (find_key(root_, at, "from_m") != nullptr))
        report(at, "from_m",
               spreader
                   ? "is needed: the upper end of a sling from the spreader"
                   : "belongs to a sling from a spreader, and there is none: without it the sling hangs from the hook");
    return good_;
  }

  /// True if no body or wire of `spec` has a name that this would give to another.
  bool names_are_free(const Specification& spec) {
    std::set<std::string> bodies, wires;
    for (const BodySpec& body : spec.bodies) bodies.insert(body.name);
    for (const WireSpec& wire : spec.wires) wires.insert(wire.name);
    const auto claim = [&](std::set<std::string>& taken, const std::string& name, const std::string& at,
                           const char* noun) {
      if (!taken.insert(name).second)
        report(at, "name", fmt::format("\"{}\" is the name of another {} already", name, noun));
    };
    claim(bodies, rigging_.name, entry_, "body");
    if (!rigging_.spreader.name.empty()) claim(bodies, rigging_.spreader.name, entry_ + ".spreader", "body");
    for (const SlingSpec& s : rigging_.spreader.slings)
      claim(wires, s.name, entry_ + ".spreader.slings." + s.name, "wire");
    for (const SlingSpec& s : rigging_.slings) claim(wires, s.name, entry_ + ".slings." + s.name, "wire");
    return good_;
  }

  /// With the load hanging.
  void hanging() {
    const RiggingPose pose = rigging_pose(rigging_, spec_, 1.0, RiggingLoad::turns);
    double mean = 0.0;
    for (const auto& s : pose.slings) mean += s.tension / static_cast<double>(pose.slings.size());
    const std::size_t uppers = rigging_.spreader.slings.size();
    for (std::size_t i = 0; i < pose.slings.size(); ++i) {
      const bool upper = i < uppers;
      const SlingSpec& spec = upper ? rigging_.spreader.slings[i] : rigging_.slings[i - uppers];
      sling(spec, pose.slings[i], entry_ + (upper ? ".spreader.slings." : ".slings.") + spec.name, mean);
    }
  }

 private:
  void report(const std::string& entry, const std::string& key, const std::string& sentence) {
    good_ = false;
    findings_.add(position_of_key(root_, entry, key), entry, key, sentence);
  }
  void few(const std::vector<SlingSpec>& slings, const std::string& entry, const std::string& key) {
    if (slings.size() < 2)
      report(
          entry, key,
          fmt::format("must be two at least, got {}: a load on one sling is a wire from block to load", slings.size()));
  }
  void lengths(const std::vector<SlingSpec>& slings, const std::string& at) {
    for (const SlingSpec& s : slings)
      if (!(s.length + s.length_error > 0.5 * s.length))
        report(at + s.name, "length_error_mm",
               fmt::format("takes away more than half of the length: {:.6g} mm of {:.6g} m", 1e3 * s.length_error,
                           s.length));
  }

  void sling(const SlingSpec& spec, const RiggingPose::Sling& s, const std::string& at, double mean) {
    const double length = spec.length + spec.length_error;
    if (const double stretch = s.distance / length - 1.0; stretch > kMostStretch)
      report(at, "length_m",
             fmt::format("is too short: {:.6g} m would stretch by {:.1f} % with the load hanging, to {:.4g} m", length,
                         100.0 * stretch, s.distance));
    else if (!(s.tension > kRestingShare * mean) && !rigging_.may_be_slack)
      report(at, "length_m",
             fmt::format(
                 "leaves the sling slack with the load hanging: {:.6g} m for a distance of {:.6g} m; give the lengths "
                 "that share the load, or say may_be_slack = true",
                 length, s.distance));
    else if (s.angle < rigging_.least_angle)
      report(at, "length_m",
             fmt::format(
                 "lays the sling at {:.1f} deg to the horizontal, at least {:.1f} by sling_angle_min_deg: its tension "
                 "is {:.2f} times the weight on it",
                 s.angle / kDegree, rigging_.least_angle / kDegree, 1.0 / std::max(std::sin(s.angle), 1e-3)));
  }

  const RiggingSpec& rigging_;
  const Specification& spec_;
  const Node& root_;
  Findings& findings_;
  std::string entry_;
  bool good_ = true;
};

}  // namespace

const Table& rigging_table() {
  static const Table table = [] {
    using S = RiggingSpec;
    TableOf<S> t(
        "rigging",
        "A hook block with slings to the load, and a spreader between them if there is one. It stands for bodies and "
        "wires, which other entries name: hoist wires lead `to` the block. The block starts where the slings are "
        "straight, or carry a load that hangs at the start.");
    t.name("name", &S::name, "Name of the block's body.");
    t.text("load", &S::load, "Body that hangs from it.").names(Reference::body).require();
    t.number("block_mass_t", &S::mass, unit::t, positive(), "Mass of the block with its hook.").require();
    t.vector("block_size_m", &S::size, unit::m, positive(),
             "Length, breadth and height of the box that its inertia is that of.");
    t.vector("block_cog_m", &S::cog, unit::m, any_value(), "Centre of gravity in the frame of the block.");
    t.vector("hook_m", &S::hook, unit::m, any_value(), "Where the slings hang, in the frame of the block.");
    t.tables("slings", &S::slings, "name", &sling_table, "Slings to the load.").require();
    t.table("spreader", &S::spreader, &spreader_table, "Spreader bar or frame.").absent("none");
    t.boolean("may_be_slack", &S::may_be_slack, "Slings may be slack with the load hanging.");
    t.number("sling_angle_min_deg", &S::least_angle, unit::deg, between(0.0, 90.0),
             "Flattest that a sling may lie, to the horizontal, with the load hanging.");
    return t.build();
  }();
  return table;
}

std::string written_entry(const Case& c, const std::string& entry) {
  for (const RiggingSpec& rigging : c.rigging) {
    const std::string at = "rigging." + as_step(rigging.name);
    if (entry == "bodies." + rigging.name) return at;
    if (!rigging.spreader.name.empty() && entry == "bodies." + rigging.spreader.name) return at + ".spreader";
    for (const SlingSpec& s : rigging.slings)
      if (entry == "wires." + s.name) return at + ".slings." + as_step(s.name);
    for (const SlingSpec& s : rigging.spreader.slings)
      if (entry == "wires." + s.name) return at + ".spreader.slings." + as_step(s.name);
  }
  return entry;
}

void expand_rigging(Case& c, const Node& root, Findings& findings) {
  const Specification given = c.specification;
  for (const RiggingSpec& rigging : c.rigging) {
    RiggingCheck check(rigging, given, root, findings);
    if (!check.counts() || !check.names_are_free(c.specification)) continue;
    try {
      check.hanging();
      add_rigging(rigging, c.specification);
    } catch (const SpecificationError& error) {
      findings.add(position_of_key(root, error.entry, error.field), error.entry, error.field, error.what());
    }
  }
}

}  // namespace stillhook
