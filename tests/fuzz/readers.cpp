#include "tests/fuzz/readers.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "planner/weather/limit_file.h"
#include "planner/weather/record_file.h"
#include "planner/weather/scatter_file.h"
#include "problems/case.h"
#include "problems/search/store.h"
#include "problems/spectra/elevation_file.h"
#include "problems/spectra/sea_files.h"
#include "results/archive.h"
#include "results/files.h"
#include "results/netcdf_file.h"
#include "sim/hull/coefficients/database.h"
#include "sim/hull/mesh/mesh_file.h"
#include "sim/specification.h"
#include "tuning/measured_table.h"

namespace stillhook::fuzz {
namespace {

const std::string kSource = STILLHOOK_SOURCE_DIR;

std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <typename Refusal, typename Read>
std::string refusal_of(const Read& read) {
  try {
    read();
    return "";
  } catch (const Refusal& error) {
    return *error.what() ? error.what() : "refused without a word";
  }
}

std::string read_case_file(const std::string& path) {
  return refusal_of<CaseError>([&] { read_case(path); });
}

std::string read_mesh_file(const std::string& path) {
  MeshFileOptions options;
  options.mend = true;
  return refusal_of<MeshError>([&] { read_mesh(path, options); });
}

DatabaseOptions database_options() {
  DatabaseOptions options;
  options.frame.length = 40.0;
  options.frame.port_starboard = false;
  options.frame.bodies[0].volume = 20240.0;  // WAMIT's files do not hold it
  options.wamit.density = 1025.0;
  options.wamit.gravity = 9.80665;
  return options;
}

std::string read_coefficients(const std::string& path) {
  return refusal_of<SpecificationError>([&] { read_database(path, database_options()); });
}

std::string read_measured(const std::string& path) {
  return refusal_of<CaseError>([&] { read_measured_table(path, {"t_s", "z_m"}); });
}

std::string read_measured_history(const std::string& path) {
  return refusal_of<CaseError>([&] { read_measured_table(path, {"time", "load.x"}); });
}

std::string read_limits(const std::string& path) {
  return refusal_of<CaseError>([&] { read_limit_file(path); });
}

std::string read_weather(const std::string& path) {
  return refusal_of<CaseError>([&] { read_record_file(path, {}); });
}

std::string read_scatter(const std::string& path) {
  return refusal_of<CaseError>([&] { read_scatter_file(path); });
}

std::string read_alpha(const std::string& path) {
  return refusal_of<CaseError>([&] { read_alpha_file(path); });
}

std::string read_spectrum(const std::string& path) {
  SpectrumFileSpec spec;
  spec.file = path;
  return refusal_of<FileError>([&] { read_spectrum_file(spec, 1025.0, 9.80665); });
}

std::string read_elevation(const std::string& path) {
  RecordFileSpec spec;
  spec.file = path;
  spec.column = "z_m";
  return refusal_of<FileError>([&] { read_elevation_file(spec); });
}

/// Two times, three frequencies, eight directions as the wavespectra library stores them.
std::string written_spectrum(const std::string& folder) {
  const std::string path = folder + "/seed-spectrum.nc";
  NetcdfFile file(path, NetcdfFile::Mode::create, path);
  const int time = file.define_dimension("time", 2), f = file.define_dimension("freq", 3),
            d = file.define_dimension("dir", 8);
  const int times = file.define("time", NC_DOUBLE, {time}, "time", "hours since 2026-11-30 00:00:00");
  const int of_f = file.define("freq", NC_DOUBLE, {f}, "frequency", "Hz");
  const int of_d = file.define("dir", NC_DOUBLE, {d}, "direction", "degree");
  const int density = file.define("efth", NC_DOUBLE, {time, f, d}, "energy", "m2 s degree-1");
  file.attribute(of_d, "standard_name", "sea_surface_wave_from_direction");
  file.put(times, std::vector<double>{0.0, 6.0});
  file.put(of_f, std::vector<double>{0.08, 0.1, 0.12});
  file.put(of_d, std::vector<double>{0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0});
  file.put(density, std::vector<double>(48, 0.01));
  file.close();
  return content_of(path);
}

std::string written_weather(const std::string& folder) {
  const std::string path = folder + "/seed-weather.nc";
  NetcdfFile file(path, NetcdfFile::Mode::create, path);
  const int time = file.define_dimension("time", 3), place = file.define_dimension("latitude", 1);
  file.put(file.define("time", NC_DOUBLE, {time}, "time", "hours since 1900-01-01 00:00:00.0"),
           std::vector<double>{1043136.0, 1043139.0, 1043142.0});
  file.put(file.define("swh", NC_DOUBLE, {time, place}, "height", "m"), std::vector<double>{1.0, 2.0, 1.5});
  file.close();
  return content_of(path);
}

std::string read_history(const std::string& path) {
  return refusal_of<FileError>([&] { read_archive(path); });
}

SearchProblem two_variables() {
  SearchProblem problem;
  problem.variable_names = {"a", "b"};
  problem.lower = Eigen::VectorXd::Zero(2);
  problem.upper = Eigen::VectorXd::Ones(2);
  problem.start = Eigen::VectorXd::Constant(2, 0.5);
  return problem;
}

std::string read_store(const std::string& path) {
  return refusal_of<StoreError>([&] {
    EvaluationStore store(path, {"1", "fuzz"}, two_variables());
    store.find(Eigen::VectorXd::Constant(2, 0.5));
    store.find(Eigen::VectorXd::Constant(2, 0.25), true);
  });
}

HydrodynamicCoefficients small_set() {
  HydrodynamicCoefficients c = read_coefficient_file(kSource + "/tests/fuzz/corpus/coefficients/box.csv");
  c.waterplane = {110.0 * 46.0};
  return c;
}

std::string written_history(const std::string& folder) {
  Trajectory run;
  run.status = RunStatus::completed;
  run.channels = {{"load.x", "m", "place"}, {"hoist.tension", "N", "tension"}};
  run.time = {0.0, 0.1, 0.2};
  run.values = {{1.0, 2.0, 3.0}, {1e6, 2e6, 3e6}};
  const std::string path = folder + "/seed.nc";
  write_archive(run, {"title", "source", "sea"}, path);
  return content_of(path);
}

std::string written_store(const std::string& folder) {
  const std::string path = folder + "/seed.sqlite";
  {
    EvaluationStore store(path, {"1", "fuzz"}, two_variables());
    Evaluation evaluation;
    evaluation.objective = 1.0;
    store.insert(Eigen::VectorXd::Constant(2, 0.5), evaluation, false, "fuzz", 0.1);
  }
  return content_of(path);
}

/// The kept files of a reader: those named fault-* are what it once failed at, the others are good.
std::vector<std::string> kept(const std::string& reader, bool faults) {
  std::vector<std::filesystem::path> paths;
  const std::filesystem::path folder = kSource + "/tests/fuzz/corpus/" + reader;
  if (std::filesystem::exists(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().filename().string().starts_with("fault-") == faults) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());  // the inputs must not depend on the order of a folder
  std::vector<std::string> contents;
  for (const auto& path : paths) contents.push_back(content_of(path.string()));
  return contents;
}

const std::string kCaseWithHull = R"(name = "fuzz"
[sea]
active = "swell"
[[sea.states]]
name = "swell"
type = "regular"
amplitude_m = 0.2
frequency_rad_per_s = 0.8
[[bodies]]
name = "hull"
mass_t = 20746.0
gyration_m = [14.0, 30.0, 30.0]
[bodies.hull]
)";
const std::string kOperation = R"(
[[operation.phases]]
name = "float"
duration_s = 10.0
)";

std::string case_with_mesh(const std::string& file) {
  return kCaseWithHull + "shape = \"mesh\"\nmesh_file = \"" + file + "\"\n" + kOperation;
}

std::string case_with_sea(const std::string& state) {
  return "name = \"fuzz\"\n[sea]\nactive = \"read\"\n[[sea.states]]\nname = \"read\"\n" + state +
         "\n[[bodies]]\nname = \"hull\"\nmass_t = 20746.0\ngyration_m = [14.0, 30.0, 30.0]\n[bodies.hull]\nshape = "
         "\"box\"\nsize_m = "
         "[110.0, 46.0, 8.0]\n" +
         kOperation;
}

std::string case_with_coefficients(const std::string& file) {
  const std::string kind = file.ends_with(".csv") ? "table" : "database";
  return kCaseWithHull + "shape = \"box\"\nsize_m = [110.0, 46.0, 8.0]\n[bodies.hydrodynamics]\nkind = \"" + kind +
         "\"\ncoefficient_file = \"" + file + "\"\n" + kOperation;
}

}  // namespace

std::vector<Reader> readers(const std::string& folder) {
  std::filesystem::copy(kSource + "/problems/hulls", folder + "/hulls");  // of the case from problems/
  const HydrodynamicCoefficients set = small_set();
  DatabaseFrame frame = database_options().frame;
  write_bemio(folder + "/seed.h5", set, frame, {BemioBody{"crane"}});
  const Matrix6 stiffness = Vector6(0.0, 0.0, 5e7, 8e9, 4e10, 0.0).asDiagonal();
  write_wamit(folder + "/seed", set, database_options().wamit, frame, {stiffness});
  std::vector<Reader> all = {
      {"case",
       "case.toml",
       {content_of(kSource + "/tests/bad_input/base.toml"),
        content_of(kSource + "/tests/planner/cases/small_lift.toml"),
        content_of(kSource + "/problems/manifold_installation.toml")},
       read_case_file},
      {"stl", "mesh.stl", {}, read_mesh_file, case_with_mesh("mesh.stl")},
      {"obj", "mesh.obj", {}, read_mesh_file, case_with_mesh("mesh.obj")},
      {"gdf", "mesh.gdf", {}, read_mesh_file, case_with_mesh("mesh.gdf")},
      {"coefficients", "set.csv", {}, read_coefficients, case_with_coefficients("set.csv")},
      {"wamit", "seed.1", {content_of(folder + "/seed.1")}, read_coefficients, case_with_coefficients("seed.1")},
      {"wamit-forces", "seed.3", {content_of(folder + "/seed.3")}, read_coefficients},
      {"wamit-stiffness", "seed.hst", {content_of(folder + "/seed.hst")}, read_coefficients},
      {"bemio", "set.h5", {content_of(folder + "/seed.h5")}, read_coefficients, case_with_coefficients("set.h5")},
      {"measured-csv", "record.csv", {}, read_measured},
      {"measured-netcdf", "record.nc", {written_history(folder)}, read_measured_history},
      {"spectrum-netcdf",
       "spectrum.nc",
       {written_spectrum(folder)},
       read_spectrum,
       case_with_sea("type = \"spectrum\"\nspectrum_file = \"spectrum.nc\"\nbearing_of_x_deg = 0.0")},
      {"spectrum-era5", "spectrum.nc", {content_of(kSource + "/docs/examples/era5_like_spectrum.nc")}, read_spectrum},
      {"spectrum-swan",
       "spectrum.spc",
       {},
       read_spectrum,
       case_with_sea("type = \"spectrum\"\nspectrum_file = \"spectrum.spc\"\nbearing_of_x_deg = 0.0")},
      {"elevation",
       "elevation.csv",
       {},
       read_elevation,
       case_with_sea("type = \"record\"\nrecord_file = \"elevation.csv\"\ncolumn = \"z_m\"\nheading_deg = 0.0")},
      {"weather-limits", "limits.csv", {content_of(kSource + "/problems/weather/limits.csv")}, read_limits},
      {"weather-record", "record.csv", {content_of(kSource + "/tests/truth/weather/seven_days.csv")}, read_weather},
      {"weather-netcdf", "record.nc", {written_weather(folder)}, read_weather},
      {"weather-scatter", "scatter.csv", {content_of(kSource + "/tests/truth/weather/scatter_wide.csv")}, read_scatter},
      {"weather-alpha", "alpha.csv", {content_of(kSource + "/problems/weather/alpha.csv")}, read_alpha},
      {"history", "history.nc", {written_history(folder)}, read_history},
      {"store", "evaluations.sqlite", {written_store(folder)}, read_store},
  };
  for (Reader& reader : all) {
    for (std::string& seed : kept(reader.name, false)) reader.seeds.push_back(std::move(seed));
    reader.faults = kept(reader.name, true);
    if (reader.name == "case") reader.program_case = "itself";
  }
  std::filesystem::remove(folder + "/seed.h5");
  return all;
}

}  // namespace stillhook::fuzz
