// Field tables of what moves a hull in waves: coefficients, viscous damping, and how coefficients are computed.
#include "problems/case_format.h"

namespace stillhook {
namespace {

Matrix6 matrix_from(const std::vector<std::vector<double>>& rows) {
  Matrix6 matrix = Matrix6::Zero();
  for (std::size_t i = 0; i < 6 && i < rows.size(); ++i)
    for (std::size_t j = 0; j < 6 && j < rows[i].size(); ++j)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
  return matrix;
}

/// Entry i of a vector, or of the diagonal of a matrix.
template <class M>
auto& entry_of(M& member, int i) {
  if constexpr (M::ColsAtCompileTime == 1)
    return member[i];
  else
    return member(i, i);
}

/// Three numbers of a vector, or of the diagonal of a matrix, from `first` on. They have defaults, so a search or a fit
/// may change one of them where the case writes none.
template <class M>
Field& half(TableOf<HydrodynamicsSpec>& t, const char* key, M member, int first, const Unit& unit, const char* doc) {
  Field& field = t.numbers(
      key, {3},
      [member, first](HydrodynamicsSpec& h, const std::vector<double>& v) {
        for (int i = 0; i < 3; ++i) entry_of(h.*member, first + i) = v[static_cast<std::size_t>(i)];
      },
      unit, not_negative(), doc);
  field.get = [member, first](const void* s) -> std::optional<Value> {
    const auto& values = static_cast<const HydrodynamicsSpec*>(s)->*member;
    return Value(std::vector<double>{entry_of(values, first), entry_of(values, first + 1), entry_of(values, first + 2)});
  };
  return field;
}

void add_viscous_damping(TableOf<HydrodynamicsSpec>& t) {
  using S = HydrodynamicsSpec;
  half(t, "linear_damping_kN_s_per_m", &S::linear_damping, 0, unit::kN_s_per_m,
       "Viscous, linear in velocity: surge, sway, heave.");
  half(t, "linear_angular_damping_kN_m_s_per_rad", &S::linear_damping, 3, unit::kN_m_s_per_rad,
       "Viscous, linear in velocity: roll, pitch, yaw.");
  half(t, "quadratic_damping_kN_s2_per_m2", &S::quadratic_damping, 0, unit::kN_s2_per_m2,
       "Viscous, in velocity times its magnitude: surge, sway, heave.");
  half(t, "quadratic_angular_damping_kN_m_s2_per_rad2", &S::quadratic_damping, 3, unit::kN_m_s2_per_rad2,
       "Viscous, in velocity times its magnitude: roll, pitch, yaw.");
  const std::pair<const char*, int> modes[] = {{"heave", 2}, {"roll", 3}, {"pitch", 4}};
  for (const auto& [mode, index] : modes) {
    const int i = index;
    t.number(
        std::string("critical_fraction_") + mode, [i](S& s) -> double& { return s.critical_fraction[i]; }, unit::one,
        between(0.0, 1.0),
        std::string("Viscous, share of critical damping in ") + mode + " at the initial equilibrium.");
  }
}

void add_self_check_tolerances(TableOf<PanelMethodSpec>& t) {
  const auto tolerance = [&t](const char* key, double SelfCheckTolerances::* member, const char* doc) {
    t.number(key, [member](PanelMethodSpec& s) -> double& { return s.tolerances.*member; }, unit::one, between(1e-4, 1.0), doc);
  };
  using T = SelfCheckTolerances;
  tolerance("symmetry_tolerance", &T::symmetry, "Self-checks: difference of A_ij and A_ji, B_ij and B_ji.");
  tolerance("negative_damping_tolerance", &T::negative_damping, "Self-checks: damping below zero, of its largest.");
  tolerance("kramers_kronig_tolerance", &T::kramers_kronig,
            "Self-check: A and B against those of the retardation functions, of the largest.");
  tolerance("coupled_kramers_kronig_tolerance", &T::coupled_kramers_kronig,
            "The same of coupled hulls: a fit rounds the top of the gap's resonance.");
  tolerance("kernel_tail_tolerance", &T::kernel_tail, "Self-check: retardation functions at their end, of their largest.");
  tolerance("haskind_tolerance", &T::haskind, "Self-check: B against the energy of the waves, one hull.");
  tolerance("coupled_haskind_tolerance", &T::coupled_haskind, "The same of coupled hulls, whose gap takes energy too.");
  tolerance("long_wave_phase_tolerance", &T::long_wave_phase, "Self-check: phase of X in long waves.");
  tolerance("long_wave_heave_tolerance", &T::long_wave_heave,
            "Self-check: heave force in long waves against that of the water plane.");
}

}  // namespace

const Table& hydrodynamics_table() {
  static const Table table = [] {
    using S = HydrodynamicsSpec;
    TableOf<S> t(
        "bodies.hydrodynamics",
        "Radiation and diffraction of a hull, and viscous damping. About the body's origin, in the heading frame.");
    t.choice<decltype(&S::kind), S::Kind>(
        "kind", &S::kind,
        {{"none", S::Kind::none},
         {"constant", S::Kind::constant},
         {"table", S::Kind::table},
         {"panels", S::Kind::panels},
         {"database", S::Kind::database},
         {"rao", S::Kind::rao}},
        "No radiation; constant added mass and damping; a coefficient file of this program; the panel method on the "
        "body's hull; WAMIT (.1 with .3, .hst) or BEMIO (.h5) output; or displacement RAOs, by which the sea alone moves "
        "the body: see `rao`.");
    t.choice<decltype(&S::radiation), S::RadiationModel>(
         "radiation", &S::radiation,
         {{"automatic", S::RadiationModel::automatic},
          {"reduced", S::RadiationModel::reduced},
          {"retardation", S::RadiationModel::retardation},
          {"direct", S::RadiationModel::direct}},
         "Radiation in the time domain: a passive state space, convolution with retardation functions, or the panel "
         "method marched along. `automatic` is `retardation` for a table, else `reduced`.")
        .only_when("kind", {"table", "panels", "database"});
    const std::vector<std::string> constant = {"constant"};
    half(t, "added_mass_t", &S::added_mass, 0, unit::t, "Surge, sway, heave.")
        .only_when("kind", constant)
        .one_of("added mass");
    half(t, "added_inertia_t_m2", &S::added_mass, 3, unit::t_m2, "Roll, pitch, yaw.")
        .only_when("kind", constant)
        .one_of("added inertia");
    t.rows(
         "added_mass_matrix_t_m", 6,
         [](S& s, const std::vector<std::vector<double>>& rows) { s.added_mass = matrix_from(rows); }, unit::t_m,
         "The whole 6 x 6 matrix instead, symmetric, by rows: surge, sway, heave, roll, pitch, yaw.")
        .only_when("kind", constant)
        .one_of("added mass");
    half(t, "damping_kN_s_per_m", &S::damping, 0, unit::kN_s_per_m, "Surge, sway, heave.")
        .only_when("kind", constant)
        .one_of("damping");
    half(t, "angular_damping_kN_m_s_per_rad", &S::damping, 3, unit::kN_m_s_per_rad, "Roll, pitch, yaw.")
        .only_when("kind", constant)
        .one_of("angular damping");
    t.rows(
         "damping_matrix_kN_s_m", 6,
         [](S& s, const std::vector<std::vector<double>>& rows) { s.damping = matrix_from(rows); }, unit::kN_s_m,
         "The whole 6 x 6 matrix instead, by rows.")
        .only_when("kind", constant)
        .one_of("damping");
    t.file("coefficient_file", &S::coefficient_file,
           "Added mass at infinite frequency, retardation functions, excitation.")
        .only_when("kind", {"table", "database"})
        .require();
    t.vector("database_origin_m", &S::database_origin, unit::m, any_value(),
             "The body's origin in the frame of the database, whose z = 0 is the still water.")
        .only_when("kind", {"database"});
    t.number("database_length_m", &S::database_length, unit::m, positive(), "WAMIT's ULEN.")
        .only_when("kind", {"database"});
    t.vector("database_xbody_m", &S::database_xbody, unit::m, any_value(),
             "WAMIT's XBODY: the point that the moments of the files are about, in the frame of the database. BEMIO "
             "files name theirs.")
        .only_when("kind", {"database"});
    t.integer("database_body", &S::database_body, Range{1.0, 100.0, false},
              "Which body of a database of several; the waves that the others radiate are left out.")
        .only_when("kind", {"database"})
        .absent("the only one");
    t.number("database_lowest_rad_per_s", &S::database_lowest, unit::rad_per_s, positive(),
             "Lower frequencies of the database are left out: those that feel the bottom, for example.")
        .only_when("kind", {"database"})
        .absent("all are used");
    t.number("database_highest_rad_per_s", &S::database_highest, unit::rad_per_s, positive(),
             "Higher frequencies of the database are left out: those with irregular frequencies, for example.")
        .only_when("kind", {"database"})
        .absent("all are used");
    t.number("database_depth_m", &S::database_depth, unit::m, positive(),
             "Depth of the water that WAMIT's files were computed in, which they do not say. BEMIO files do.")
        .only_when("kind", {"database"})
        .absent("no bottom");
    t.choice<decltype(&S::database_in_frequency), bool>(
         "database_first_column", &S::database_in_frequency, {{"period", false}, {"frequency", true}},
         "What the first column of WAMIT's files is: a period in s, or a frequency in rad/s (IPEROUT = 2).")
        .only_when("kind", {"database"});
    t.boolean("port_starboard", &S::port_starboard, "The headings 0 to 180 deg of the database are mirrored.")
        .only_when("kind", {"database"});
    t.boolean("axisymmetric", &S::axisymmetric,
              "A body of revolution about the vertical through the point that the moments are about: one heading of the "
              "database stands for all.")
        .only_when("kind", {"database"});
    t.number("panel_length_m", &S::panel_length, unit::m, positive(), "Longest panel of the hull.")
        .only_when("kind", {"panels"})
        .absent("an eighth of the breadth, less in short waves");
    const std::vector<std::string> computed = {"table", "panels", "database"};
    t.number("added_mass_factor", &S::added_mass_factor, unit::one, positive(),
             "On the added mass at infinite frequency: a correction, by a fit or by judgement.")
        .only_when("kind", computed);
    t.number("radiation_factor", &S::radiation_factor, unit::one, not_negative(),
             "On the memory of the radiation, that is on the damping and on what the added mass has above that at "
             "infinite frequency.")
        .only_when("kind", computed);
    t.number("diffraction_factor", &S::diffraction_factor, unit::one, any_value(), "On the diffraction force.")
        .only_when("kind", computed);
    t.text("coupled_with", &S::coupled_with, "Body whose hull and this one feel each other's waves.")
        .only_when("kind", {"panels"})
        .names(Reference::body)
        .absent("none");
    t.text("coupled_until", &S::coupled_until, "Phase with whose start the coupling ends.")
        .only_when("kind", {"panels"})
        .names(Reference::phase)
        .absent("the end");
    t.table("rao", &S::rao, &rao_table,
            "Displacement RAOs: the body moves about its given pose as they say, and nothing else moves it.")
        .only_when("kind", {"rao"})
        .require();
    add_viscous_damping(t);
    return t.build();
  }();
  return table;
}

const Table& panel_method_table() {
  static const Table table = [] {
    using S = PanelMethodSpec;
    TableOf<S> t("panel_method", "How coefficients of hulls are computed and what is accepted of them.");
    t.number("lowest_rad_per_s", &S::lowest, unit::rad_per_s, between(0.05, 2.0), "Lowest frequency.")
        .absent("0.2; 0.1 over a bed that its waves feel");
    t.number("highest_rad_per_s", &S::highest, unit::rad_per_s, between(0.3, 5.0), "Highest frequency.")
        .absent("2, up to 3 where a sea of the case has more than a tenth of its energy above, less for a hull whose "
                "diagonal is more than 8.3 such waves");
    t.integer("frequencies", &S::frequencies, between(20.0, 200.0), "How many are computed, evenly in the logarithm.")
        .absent("32 from 0.2 to 2, and as many more as the wave's phase along the hull needs");
    t.integer("headings", &S::headings, between(4.0, 360.0), "Wave directions around the circle.")
        .absent("as many as the shortest waves need");
    t.number("refinement", &S::refinement, unit::one, between(0.25, 4.0), "Every panel is divided by this.");
    t.number("direct_step_s", &S::direct_step, unit::s, positive(), "Time step of radiation = \"direct\".");
    t.number("direct_lowest_rad_per_s", &S::direct_lowest, unit::rad_per_s, between(0.1, 3.0),
             "Longest wave that the water surface of radiation = \"direct\" is made for.");
    t.number("direct_highest_rad_per_s", &S::direct_highest, unit::rad_per_s, between(0.2, 4.0),
             "Shortest wave that it is made for.");
    t.number("fit_tolerance", &S::fit_tolerance, unit::one, between(0.001, 0.2),
             "Of radiation = \"reduced\": rms error of each entry over the band.");
    t.text("accept_failed_checks", &S::accepted_checks,
           "Self-checks of coefficients that may fail, by name, with commas in between.")
        .absent("none");
    add_self_check_tolerances(t);
    t.choice<decltype(&S::beyond), S::Beyond>(
        "beyond", &S::beyond, {{"limit", S::Beyond::limit}, {"cut", S::Beyond::cut}, {"refuse", S::Beyond::refuse}},
        "Waves shorter than those of the coefficients: diffracted as in the limit of short waves, acting without "
        "diffraction (the report says how much of the sea), or refused when they hold more than 1 % of its energy.");
    t.number("memory_gb", &S::memory, unit::one, positive(),
             "Most memory that a panel computation may take; a hull that needs more is refused before it begins.");
    return t.build();
  }();
  return table;
}

}  // namespace stillhook
