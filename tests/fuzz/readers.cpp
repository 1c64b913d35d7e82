#include "tests/fuzz/readers.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "problems/case.h"
#include "problems/search/store.h"
#include "results/archive.h"
#include "results/files.h"
#include "sim/hull/database.h"
#include "sim/hull/mesh_file.h"
#include "sim/specification.h"
#include "tuning/measured_table.h"

namespace stillhook::fuzz {
namespace {

const std::string kSource = STILLHOOK_SOURCE_DIR;

std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool read_case_file(const std::string& path) {
  try {
    read_case(path);
    return true;
  } catch (const CaseError&) {
    return false;
  }
}

bool read_mesh_file(const std::string& path) {
  MeshFileOptions options;
  options.mend = true;
  try {
    read_mesh(path, options);
    return true;
  } catch (const MeshError&) {
    return false;
  }
}

DatabaseOptions database_options() {
  DatabaseOptions options;
  options.frame.length = 40.0;
  options.frame.port_starboard = false;
  options.wamit.density = 1025.0;
  options.wamit.gravity = 9.80665;
  return options;
}

bool read_coefficients(const std::string& path) {
  try {
    read_database(path, database_options());
    return true;
  } catch (const SpecificationError&) {
    return false;
  }
}

bool read_measured(const std::string& path) {
  try {
    read_measured_table(path, {"t_s", "z_m"});
    return true;
  } catch (const CaseError&) {
    return false;
  }
}

bool read_history(const std::string& path) {
  try {
    read_archive(path);
    return true;
  } catch (const FileError&) {
    return false;
  }
}

SearchProblem two_variables() {
  SearchProblem problem;
  problem.variable_names = {"a", "b"};
  problem.lower = Eigen::VectorXd::Zero(2);
  problem.upper = Eigen::VectorXd::Ones(2);
  problem.start = Eigen::VectorXd::Constant(2, 0.5);
  return problem;
}

bool read_store(const std::string& path) {
  try {
    EvaluationStore store(path, {"1", "fuzz"}, two_variables());
    store.find(Eigen::VectorXd::Constant(2, 0.5));
    store.find(Eigen::VectorXd::Constant(2, 0.25), true);
    return true;
  } catch (const StoreError&) {
    return false;
  }
}

HydrodynamicCoefficients small_set() {
  HydrodynamicCoefficients c = read_coefficient_file(kSource + "/problems/hulls/crane_110x46x4.csv");
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

std::string column_of_numbers(const std::string& separator) {
  std::string text = "t_s" + separator + "z_m\n";
  for (int i = 0; i < 40; ++i) text += std::to_string(0.1 * i) + separator + std::to_string(0.01 * (i % 7)) + "\n";
  return text;
}

}  // namespace

std::vector<Reader> readers(const std::string& folder) {
  const HydrodynamicCoefficients set = small_set();
  DatabaseFrame frame = database_options().frame;
  write_bemio(folder + "/seed.h5", set, frame, {BemioBody{"crane"}});
  write_wamit(folder + "/seed", set, database_options().wamit, frame);
  const std::string stl =
      "solid box\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid box\n";
  const std::string gdf = "box\n1 9.80665\n0 0\n1\n0 0 0 1 0 0 1 1 0 0 1 0\n";
  std::vector<Reader> all = {
      {"case",
       "case.toml",
       {content_of(kSource + "/tests/bad_input/base.toml"),
        content_of(kSource + "/tests/planner/cases/small_lift.toml"),
        content_of(kSource + "/problems/manifold_installation.toml")},
       read_case_file},
      {"stl", "mesh.stl", {stl}, read_mesh_file},
      {"obj",
       "mesh.obj",
       {content_of(kSource + "/tests/bad_input/inverted.obj"), content_of(kSource + "/tests/bad_input/open.obj")},
       read_mesh_file},
      {"gdf", "mesh.gdf", {gdf}, read_mesh_file},
      {"coefficients",
       "set.csv",
       {content_of(kSource + "/problems/hulls/crane_110x46x4.csv").substr(0, 60'000)},
       read_coefficients},
      {"wamit", "seed.1", {content_of(folder + "/seed.1")}, read_coefficients},
      {"bemio", "set.h5", {content_of(folder + "/seed.h5")}, read_coefficients},
      {"measured-csv",
       "record.csv",
       {column_of_numbers(","), column_of_numbers("\t"), column_of_numbers(";")},
       read_measured},
      {"measured-netcdf", "record.nc", {written_history(folder)}, read_measured},
      {"history", "history.nc", {written_history(folder)}, read_history},
      {"store", "evaluations.sqlite", {written_store(folder)}, read_store},
  };
  std::filesystem::remove(folder + "/seed.h5");
  return all;
}

}  // namespace stillhook::fuzz
