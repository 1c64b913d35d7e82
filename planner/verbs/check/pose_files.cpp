#include "planner/verbs/check/pose_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "results/files.h"
#include "results/pose_drawing.h"

namespace stillhook {
namespace {

namespace fs = std::filesystem;

void write_drawing(const std::string& file, const std::string& svg, bool replace) {
  if (!replace && fs::exists(file))
    throw FileError(file + ": exists already; use --force to replace it, or another --draw");
  write_file(file, svg + "\n");
}

}  // namespace

std::vector<std::string> write_pose_drawings(const Model& model, const Operation& operation, const std::string& path,
                                             bool replace) {
  const Specification& s = model.specification();
  Trajectory at_rest;
  at_rest.static_poses = operation.static_poses;
  const Scene scene = build_scene(s, at_rest);
  if (fs::path(path).extension() == ".svg") {
    for (const PoseDrawing& start : draw_named_poses(scene, {operation.static_poses.front()}, s.operation.target))
      write_drawing(path, start.svg, replace);
    return {path};
  }
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(fmt::format("{}: cannot be made a folder for drawings: {}", path, error.message()));
  std::vector<std::string> files;
  for (const PoseDrawing& pose : draw_named_poses(scene, operation.static_poses, s.operation.target)) {
    files.push_back((fs::path(path) / fmt::format("{}_{}.svg", files.size() + 1, pose.name)).string());
    write_drawing(files.back(), pose.svg, replace);
  }
  return files;
}

}  // namespace stillhook
