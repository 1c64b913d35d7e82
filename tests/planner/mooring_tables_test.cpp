// The moorings that `check` prints, against the stiffness of a spread worked out by hand.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/planner/program.h"

using namespace stillhook;

namespace {

/// A box of 40 x 20 m at the heading, held by four linear lines of 100 kN/m from its corners, along 45 deg to its axes.
std::string write_case(const Folder& folder, double heading_deg) {
  std::ofstream file(folder / "moored.toml");
  file << "name = \"moored\"\n[sea]\nactive = \"calm\"\n[[sea.states]]\nname = \"calm\"\ntype = \"calm\"\n"
       << "[[bodies]]\nname = \"barge\"\nmass_t = 1640.0\ngyration_m = [6.5, 11.5, 12.5]\nattitude_deg = [0.0, 0.0, "
       << heading_deg << "]\n"
       << "hull = { shape = \"box\", size_m = [40.0, 20.0, 4.0], centre_m = [0.0, 0.0, 0.0], panel_length_m = 10.0 }\n";
  const double places[4][3] = {{20, 10, 45}, {20, -10, -45}, {-20, -10, -135}, {-20, 10, 135}};
  for (int i = 0; i < 4; ++i)
    file << "[[moorings]]\nname = \"line_" << i << "\"\ntype = \"linear\"\nbody = \"barge\"\nfairlead_m = ["
         << places[i][0] << ", " << places[i][1] << ", 0.0]\nazimuth_deg = " << places[i][2] + heading_deg
         << "\npretension_kN = 50.0\nstiffness_kN_per_m = 100.0\nanchor_distance_m = 1.0e6\n";
  file << "[operation]\nload = \"barge\"\ncrane = \"barge\"\n[[operation.phases]]\nname = \"waiting\"\nduration_s = "
          "10.0\n";
  return folder / "moored.toml";
}

}  // namespace

TEST_CASE("check prints where moorings go and how stiffly they hold", "[check]") {
  // Far anchors: each line is a spring k along its direction d. Surge and sway: 4 k cos^2 45 deg = 2 k = 200 kN/m. Yaw:
  // sum k (r x d)^2 + T (r . d) = 4 (100 kN/m (10 m / sqrt 2)^2 + 50 kN 30 m / sqrt 2) = 24,243 kN m/rad; per degree
  // 423.1.
  for (const double heading : {0.0, 70.0}) {
    const Folder folder;
    const Result check = run(folder, {"check", write_case(folder, heading), "--json"});
    REQUIRE(check.code == 0);
    const auto document = nlohmann::json::parse(check.out);
    nlohmann::json row, lines;
    for (const auto& table : document["tables"]) {
      if (table["title"] == "Mooring stiffness") row = table["rows"][0];
      if (table["title"] == "Mooring lines") lines = table["rows"];
    }
    REQUIRE(lines.size() == 4);
    CHECK(lines[0][5].get<double>() == Approx(50.0));  // the pretension, horizontal: the whole tension
    REQUIRE(row.size() == 5);
    CHECK(row[1].get<double>() == 4);
    // One decimal is printed; pretension over the distance of the anchors adds less than 1e-3 kN/m.
    CHECK(row[2].get<double>() == Approx(200.0).margin(0.06));
    CHECK(row[3].get<double>() == Approx(200.0).margin(0.06));
    CHECK(row[4].get<double>() == Approx(423.1).margin(0.11));
  }
}
