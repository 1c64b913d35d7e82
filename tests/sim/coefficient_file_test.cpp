#include "sim/hull/coefficients/coefficient_file.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "sim/specification.h"

namespace stillhook {
namespace {

/// A file that lives as long as the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) {
    static int count = 0;
    path_ = (std::filesystem::temp_directory_path() /
             ("stillhook_coefficients_" + std::to_string(::getpid()) + "_" +
              std::to_string(count++) + ".csv"))
                .string();
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

const char* const kHeader =
    "# a hull\n"
    "stillhook_coefficients,1\n"
    "description,made up, for a test\n"
    "hulls,1\n"
    "reference_point,body_origin\n"
    "axes,x_forward_y_port_z_up\n"
    "waterline_m,0.5\n"
    "volume_m3,20\n"
    "density_kg_m3,1000\n"
    "gravity_m_s2,9.81\n"
    "length_m,10\n"
    "time_factor,exp(-i omega t)\n"
    "wave_heading,towards\n"
    "symmetry,port_starboard\n"
    "quantity,i,j_or_heading_deg,omega_rad_s_or_t_s,value,phase_deg\n";  // line 15

const char* const kRows =
    "Ainf,1,1,,100,\n"  // 16
    "Ainf,5,5,,400,\n"  // 17
    "Ainf,1,5,,-20,\n"  // 18
    "K,1,1,0,8,\n"      // 19
    "K,1,1,0.25,4,\n"   // 20
    "K,1,1,0.5,-1,\n"   // 21
    "K,1,5,0,2,\n"      // 22
    "K,1,5,0.25,1,\n"   // 23
    "A,1,1,0.5,110,\n"  // 24
    "B,1,1,0.5,12,\n";  // 25

std::string excitation() {
  std::string rows;
  for (const char* heading : {"0", "90", "180"})
    for (int i = 1; i <= 6; ++i)
      rows += "X," + std::to_string(i) + "," + heading + ",0.5," +
              (std::string(heading) == "90" ? "30"
               : i % 2                      ? "7"
                                            : "0") +
              ",60\n";
  return rows;
}

std::string valid() { return std::string(kHeader) + kRows + excitation() + "end,28\n"; }

std::string replaced(std::string text, const std::string& old, const std::string& fresh) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), fresh);
}

}  // namespace

TEST_CASE("a coefficient file is read with its conventions", "[coefficient_file]") {
  const TemporaryFile file(valid());
  const HydrodynamicCoefficients c = read_coefficient_file(file.path());
  CHECK(c.description == "made up, for a test");
  CHECK(c.waterline == 0.5);
  CHECK(c.density == 1000.0);
  CHECK(c.gravity == 9.81);
  CHECK(c.length == 10.0);
  CHECK(c.volume == std::vector<double>{20.0});
  CHECK(c.A_inf(0, 4) == -20.0);
  CHECK(c.A_inf(4, 0) == -20.0);  // by reciprocity
  CHECK(c.A_inf(2, 2) == 0.0);
  REQUIRE(c.retardation.kernels.size() == 3);
  CHECK(c.retardation.interval == 0.25);
  CHECK(c.retardation.kernels[0].value == std::vector<double>{8.0, 4.0, -1.0});
  CHECK(c.retardation.kernels[2].i == 4);
  CHECK(c.retardation.kernels[2].j == 0);
  REQUIRE(c.frequency.size() == 1);
  CHECK(c.frequency[0].A(0, 0) == 110.0);
  CHECK(c.frequency[0].B(0, 0) == 12.0);
  // Headings 0, 90, 180 and the mirror of 90; surge is even, sway odd; a positive phase is a lag: arg X > 0 with
  // Re[X exp(i th)], th falling in time.
  REQUIRE(c.excitation.headings.size() == 4);
  CHECK(c.excitation.headings[3] == Approx(1.5 * std::numbers::pi));
  CHECK(std::arg(c.excitation.at(0, 1, 0)) == Approx(std::numbers::pi / 3.0));
  CHECK(std::abs(c.excitation.at(0, 3, 0) - c.excitation.at(0, 1, 0)) < 1e-12);
  CHECK(std::abs(c.excitation.at(0, 3, 1) + c.excitation.at(0, 1, 1)) < 1e-12);
  CHECK(std::abs(c.excitation.at(0, 1, 1)) == Approx(30.0));
}

TEST_CASE("broken coefficient files are refused by line", "[coefficient_file]") {
  struct Broken {
    std::string text;
    int line;
    std::string part;
  };
  const std::string good = valid();
  const std::vector<Broken> corpus = {
      {"", 1, "empty"},
      {"# nothing\n", 1, "empty"},
      {"solid box\n", 1, "must begin with"},
      {std::string("stillhook_coefficients,1\nhulls\0,1\n", 35), 2, "not text"},
      {replaced(good, "coefficients,1", "coefficients,2"), 2, "version 1"},
      {replaced(good, "hulls,1", "hull,1"), 4, "unknown key \"hull\""},
      {replaced(good, "hulls,1", "hulls,1\nhulls,1"), 5, "given twice"},
      {replaced(good, "hulls,1", "hulls,9"), 4, "hulls must be"},
      {replaced(good, "density_kg_m3,1000", "density_kg_m3,0"), 9, "must be > 0"},
      {replaced(good, "density_kg_m3,1000", "density_kg_m3,heavy"), 9, "must be a number"},
      {replaced(good, "density_kg_m3,1000\n", ""), 14, "does not give \"density_kg_m3\""},
      {replaced(good, "volume_m3,20", "volume_m3,20,30"), 8, "one number a hull"},
      {replaced(good, "volume_m3,20", "volume_m3,-20"), 8, "must be > 0"},
      {replaced(good, "exp(-i omega t)", "exp(+i omega t)"), 12, "time_factor must be"},
      {replaced(good, "wave_heading,towards", "wave_heading,from"), 13, "wave_heading must be"},
      {replaced(good, "body_origin", "centre_of_gravity"), 5, "reference_point must be"},
      {replaced(good, "value,phase_deg", "phase_deg,value"), 15, "columns"},
      {std::string(kHeader).substr(0, 120), 6, "ends before the line of columns"},
      {replaced(good, "K,1,1,0.25,4,", "K,1,1,0.25,nan,"), 20, "finite"},
      {replaced(good, "K,1,1,0.25,4,", "K,1,1,0.25,4x,"), 20, "must be a number"},
      {replaced(good, "K,1,1,0.25,4,", "K,1,1,0.25"), 20, "6 fields"},
      {replaced(good, "K,1,1,0.25,4,", "Q,1,1,0.25,4,"), 20, "unknown quantity"},
      {replaced(good, "K,1,1,0.25,4,", "K,7,1,0.25,4,"), 20, "mode from 1 to 6"},
      {replaced(good, "K,1,1,0.25,4,", "K,1,1.5,0.25,4,"), 20, "mode from 1 to 6"},
      {replaced(good, "K,1,1,0.25,4,", "K,1,1,0.25,4,30"), 20, "only X has a phase"},
      {replaced(good, "K,1,1,0.25,4,", "K,1,1,0,4,"), 20, "repeats line 19"},
      {replaced(good, "K,1,1,0.25,4,", "K,1,1,0.6,4,"), 21, "must increase"},
      {replaced(good, "K,1,1,0.5,-1,", "K,1,1,0.6,-1,"), 21, "evenly spaced"},
      {replaced(good, "K,1,5,0.25,1,", "K,1,5,0.3,1,"), 23, "evenly spaced"},
      {replaced(good, "K,1,1,0,8,", "K,1,1,0.1,8,"), 19, "begin at t = 0"},
      {replaced(good, "Ainf,1,1,,100,", "Ainf,1,1,0.5,100,"), 16, "neither frequency nor time"},
      {replaced(good, "Ainf,1,1,,100,", "Ainf,1,1,,-100,"), 16, "negative"},
      {replaced(replaced(good, "Ainf,1,5,,-20,", "Ainf,1,5,,-20,\nAinf,5,1,,20,"), "end,28", "end,29"), 18,
       "not symmetric"},
      {replaced(
           replaced(good, "K,1,5,0.25,1,\n", "K,1,5,0.25,1,\nK,5,5,0,9,\nK,5,5,0.25,5,\nK,5,1,0,2,\nK,5,1,0.25,-1,\n"),
           "end,28", "end,32"),
       23, "not symmetric"},
      {replaced(good, "B,1,1,0.5,12,", "B,1,1,0.5,-12,"), 25, "negative"},
      {replaced(good, "B,1,1,0.5,12,", "B,1,1,0.6,12,"), 25, "without A"},
      {replaced(replaced(good, "X,2,90,0.5,30,60\n", ""), "end,28", "end,27"), 42,
       "incomplete: mode 2 at 0.5 rad/s and 90"},
      {replaced(good, "X,2,90,0.5,30,60", "X,2,80,0.5,30,60"), 26, "evenly spaced"},
      {replaced(good, "X,2,90,0.5,30,60", "X,2,190,0.5,30,60"), 33, "0..180"},
      {replaced(good, "X,2,90,0.5,30,60", "X,2,90,0.5,-30,60"), 33, "amplitude"},
      {replaced(good, "X,2,90,0.5,30,60", "X,2,90,0,30,60"), 33, "> 0"},
      {replaced(good, "X,2,90,0.5,30,60", "X,2,90,0.5,30,"), 33, "phase_deg"},
      {replaced(good, "X,2,0,0.5,0,60", "X,2,0,0.5,9,60"), 27, "must vanish"},
      {replaced(good, "end,28\n", ""), 43, "cut off"},
      {replaced(good, "X,6,180,0.5,0,60\n", ""), 43, "27 rows"},
      {good + "K,1,1,0.75,0,\n", 45, "more after"},
  };
  for (const Broken& broken : corpus) {
    const TemporaryFile file(broken.text);
    INFO(broken.part << " expected at line " << broken.line);
    try {
      read_coefficient_file(file.path());
      FAIL_CHECK("was accepted");
    } catch (const SpecificationError& error) {
      INFO(error.what());
      CHECK(error.entry == file.path() + ":" + std::to_string(broken.line));
      CHECK(std::string(error.what()).find(broken.part) != std::string::npos);
    }
  }
}

TEST_CASE("a coefficient file that is not there is named", "[coefficient_file]") {
  CHECK_THROWS_WITH(read_coefficient_file("/nowhere/hull.csv"), Catch::Contains("/nowhere/hull.csv: cannot be opened"));
}

TEST_CASE("the crane hull's file states what the reference data state", "[coefficient_file]") {
  const HydrodynamicCoefficients c = read_coefficient_file(STILLHOOK_SOURCE_DIR "/problems/hulls/crane_110x46x4.csv");
  CHECK(c.A_inf(2, 2) == 8.832169e7);
  CHECK(c.retardation.interval == Approx(0.1));
  CHECK(c.retardation.kernels.size() == 10);  // 6 diagonal, (1,5), (2,4) and their transposes
  CHECK(c.excitation.frequencies == std::vector<double>{0.4, 0.571, 0.628, 0.8, 1.0, 1.2});
  CHECK(c.excitation.headings.size() == 8);
  // Sway in the paper's wave at 45 deg, and its mirror at 315 deg.
  CHECK(std::abs(c.excitation.at(2, 1, 1)) == Approx(3.343952e6));
  CHECK(std::arg(c.excitation.at(2, 1, 1)) == Approx(-93.109 * std::numbers::pi / 180.0));
  CHECK(std::abs(c.excitation.at(2, 7, 1) + c.excitation.at(2, 1, 1)) < 1.0);
}

}  // namespace stillhook
