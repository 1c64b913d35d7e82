// The data of the 3-D replay and of the interactive plots, as one compressed text that the page carries.
//
// Text: base64 of zlib of [length of the header, uint32 little-endian][header, JSON][blocks]. The header names
//   time      {at, count}: milliseconds, pack_integers()
//   series    [{at, low, step, order}]: pack_series(), one value a time
//   scene     bodies, lines, moorings, surfaces, arrows, sea, target: SI, frames as in scene.h; "pose" holds the seven series
//             of a body: x, y, z of Bo in W, then the quaternion w, x, y, z of R_WB
//   phases    [{name, stage, start, end}], contacts [{name, kind, time, ...}]
//   plots     the figures of the report in their order: lines, limits, ranges, markers
//   readings  series that the scene shows as numbers
//   opens     the time that is shown first, s
// with `at` counted in bytes from the start of the blocks. viewer/source/payload.js reads it.
#pragma once

#include <string>
#include <vector>

#include "results/report.h"
#include "results/report_parts.h"
#include "results/run_view.h"
#include "results/scene.h"

namespace stillhook {

/// `budget`: most numbers kept. A longer run keeps the smallest and the largest of every few samples of a plot's lines,
/// in their order, so that no peak is lost, and every so many poses. Throws std::runtime_error.
std::string replay_text(const ReportData& data, const RunView& view, const Scene& scene,
                        const std::vector<ReportFigure>& figures, std::size_t budget = 6'000'000);

}  // namespace stillhook
