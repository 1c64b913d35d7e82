// Response amplitude operators of a case's moored lift at its initial equilibrium, sampled for tables and plots.
#pragma once

#include <string>
#include <vector>

#include "sim/response.h"

namespace stillhook {

/// Of one body: surge ... yaw of its centre of gravity along its heading.
struct BodyResponse {
  int body = 0;
  std::string name;
  Vector3 point = Vector3::Zero();                              // m, in B
  std::vector<std::vector<ResponseAmplitude::Vector6c>> value;  // [heading][frequency]; m/m and rad/m
};

struct ResponseCurves {
  std::vector<double> frequencies;   // rad/s
  std::vector<double> headings;      // rad, in W
  std::vector<BodyResponse> bodies;  // those with a hull, and the load
};

/// Over the band that all hulls' sets share, with extra frequencies around each natural one. Headings that the sets do
/// not resolve at the highest frequency give NaN where they do not.
ResponseCurves response_curves(const Model& model, const std::vector<double>& headings);

/// Headings a vessel is judged by: head, bow quartering and beam seas of the first body with a hull, rad in W.
std::vector<double> usual_headings(const Model& model);

}  // namespace stillhook
