// Field table of displacement RAOs: the file, and the conventions it was written in.
#include "problems/case_format.h"

namespace stillhook {
namespace {

void add_conventions(TableOf<RaoSpec>& t) {
  const std::vector<std::string> csv = {"csv"};
  t.choice<decltype(&RaoSpec::phase), RaoSpec::Phase>(
       "phase", &RaoSpec::phase, {{"lag", RaoSpec::Phase::lag}, {"lead", RaoSpec::Phase::lead}},
       "What a positive phase means: the motion is at its top after the wave (lag) "
       "or before it (lead).")
      .only_when("format", csv)
      .require();
  t.choice<decltype(&RaoSpec::event), RaoSpec::Event>(
       "phase_of", &RaoSpec::event,
       {{"crest", RaoSpec::Event::crest},
        {"trough", RaoSpec::Event::trough},
        {"rising", RaoSpec::Event::rising},
        {"falling", RaoSpec::Event::falling}},
       "The instant of the wave at the phase origin that phases count from: its "
       "crest, its trough, or where it passes the still water rising or falling.")
      .only_when("format", csv)
      .require();
  t.choice<decltype(&RaoSpec::direction), RaoSpec::Direction>(
       "headings", &RaoSpec::direction, {{"towards", RaoSpec::Direction::towards}, {"from", RaoSpec::Direction::from}},
       "What a heading names: where the waves go (0 is a following sea) or where they come from (0 is a head sea).")
      .only_when("format", csv)
      .require();
  t.choice<decltype(&RaoSpec::turn), RaoSpec::Turn>(
       "headings_grow_to", &RaoSpec::turn, {{"port", RaoSpec::Turn::port}, {"starboard", RaoSpec::Turn::starboard}},
       "The side that a heading of 90 deg points to.")
      .only_when("format", csv)
      .require();
  struct Sign {
    const char *key, *ours, *reversed, *doc;
  };
  constexpr Sign kSigns[] = {
      {"surge", "forward", "aft", "Positive surge."},     {"sway", "port", "starboard", "Positive sway."},
      {"heave", "up", "down", "Positive heave."},         {"roll", "starboard_down", "port_down", "Positive roll."},
      {"pitch", "bow_down", "bow_up", "Positive pitch."}, {"yaw", "bow_to_port", "bow_to_starboard", "Positive yaw."}};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto member = [i](RaoSpec& s) -> bool& { return s.reversed[i]; };
    t.choice<decltype(member), bool>(kSigns[i].key, member, {{kSigns[i].ours, false}, {kSigns[i].reversed, true}},
                                     kSigns[i].doc)
        .only_when("format", csv)
        .require();
  }
}

void add_wamit(TableOf<RaoSpec>& t) {
  const std::vector<std::string> wamit = {"wamit"};
  t.number("wamit_length_m", &RaoSpec::length, unit::m, positive(),
           "ULEN of the run: rotations are multiples of 1/ULEN.")
      .only_when("format", wamit)
      .require();
  t.choice<decltype(&RaoSpec::column), RaoSpec::Column>(
       "wamit_first_column", &RaoSpec::column,
       {{"period", RaoSpec::Column::period}, {"frequency", RaoSpec::Column::frequency}},
       "What the first column is: a period in s, or a frequency in rad/s (IPEROUT = 2).")
      .only_when("format", wamit);
  t.integer("wamit_body", &RaoSpec::body, Range{1.0, 100.0, false}, "Which body of a file of several.")
      .only_when("format", wamit)
      .absent("the only one");
}

}  // namespace

const Table& rao_table() {
  static const Table table = [] {
    TableOf<RaoSpec> t(
        "bodies.hydrodynamics.rao",
        "Displacement RAOs of a vessel, and the conventions they were written in. None of these is assumed.");
    t.file("file", &RaoSpec::file,
           "The table: CSV with the units in the names of its columns (docs/stations.md), or WAMIT's .4.")
        .require();
    t.choice<decltype(&RaoSpec::format), RaoSpec::Format>(
         "format", &RaoSpec::format, {{"csv", RaoSpec::Format::csv}, {"wamit", RaoSpec::Format::wamit}},
         "Named columns, or WAMIT's .4, whose conventions are fixed: phases lead, "
         "of the crest, headings towards, x forward, y port, z up.")
        .require();
    t.vector("reference_m", &RaoSpec::reference, unit::m, any_value(),
             "The point of the body frame whose surge, sway and heave the file gives (WAMIT: XBODY).")
        .require();
    Field& origin = t.numbers(
        "phase_origin_m", {2},
        [](RaoSpec& s, const std::vector<double>& v) {
          s.phase_x = v[0];
          s.phase_y = v[1];
        },
        unit::m, any_value(),
        "x and y, in the body frame at its mean pose, of the place where the wave is measured that phases are relative "
        "to (WAMIT: the origin of its global frame).");
    origin.get = [](const void* s) -> std::optional<Value> {
      const RaoSpec& spec = *static_cast<const RaoSpec*>(s);
      return Value(std::vector<double>{spec.phase_x, spec.phase_y});
    };
    origin.require();
    add_conventions(t);
    add_wamit(t);
    t.boolean("port_starboard", &RaoSpec::port_starboard,
              "The file has the headings of one side; those of the other are mirrored at y = 0 of the body frame.");
    t.choice<decltype(&RaoSpec::beyond), RaoSpec::Beyond>(
        "beyond", &RaoSpec::beyond, {{"refuse", RaoSpec::Beyond::refuse}, {"cut", RaoSpec::Beyond::cut}},
        "Waves shorter than the shortest period of the file, where they hold "
        "more than 1 % of the sea's energy: refused, "
        "or cut, which says that they do not move the vessel.");
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
