// Channels that every run has beside those of its force elements: poses and velocities of bodies, positions of drives,
// motions and loads of joints, the sea. The elements' own channels stand with the elements.
#pragma once

#include <array>

#include "sim/body_spec.h"
#include "sim/channel_kind.h"
#include "sim/lifting/gear_spec.h"
#include "sim/multibody/joint_spec.h"
#include "sim/sea/sea_spec.h"

namespace stillhook {

/// What is recorded of every entry, in the order in which measure() writes it.
namespace body_channels {
inline constexpr ChannelKind<BodySpec> x{"x", "m", "position of the origin"};
inline constexpr ChannelKind<BodySpec> y{"y", "m", "position of the origin"};
inline constexpr ChannelKind<BodySpec> z{"z", "m", "position of the origin"};
inline constexpr ChannelKind<BodySpec> roll{"roll", "rad", "ZYX Euler angle"};
inline constexpr ChannelKind<BodySpec> pitch{"pitch", "rad", "ZYX Euler angle"};
inline constexpr ChannelKind<BodySpec> yaw{"yaw", "rad", "ZYX Euler angle"};
inline constexpr ChannelKind<BodySpec> vx{"vx", "m/s", "velocity of the origin"};
inline constexpr ChannelKind<BodySpec> vy{"vy", "m/s", "velocity of the origin"};
inline constexpr ChannelKind<BodySpec> vz{"vz", "m/s", "velocity of the origin"};
inline constexpr ChannelKind<BodySpec> wx{"wx", "rad/s", "angular velocity in body axes"};
inline constexpr ChannelKind<BodySpec> wy{"wy", "rad/s", "angular velocity in body axes"};
inline constexpr ChannelKind<BodySpec> wz{"wz", "rad/s", "angular velocity in body axes"};
inline constexpr std::array all = {x, y, z, roll, pitch, yaw, vx, vy, vz, wx, wy, wz};
inline constexpr std::array position = {x, y, z};
inline constexpr std::array attitude = {roll, pitch, yaw};
inline constexpr std::array pose = {x, y, z, roll, pitch, yaw};
}  // namespace body_channels

/// A drive's unit is that of what it moves (sim/drive_unit.h): a winch's metres, a hinge's radians, shares of ballast.
namespace drive_channels {
inline constexpr ChannelKind<DriveSpec> position{"position", "", "position of the drive"};
inline constexpr ChannelKind<DriveSpec> rate{"rate", "", "rate of the drive"};
}  // namespace drive_channels

/// `slide` of a sliding joint, `angle` of every other; then the loads.
namespace joint_channels {
inline constexpr ChannelKind<JointSpec> slide{"slide", "m", "travel along the axis from the initial pose"};
inline constexpr ChannelKind<JointSpec> angle{"angle", "rad", "angle about the axis from the initial pose"};
inline constexpr ChannelKind<JointSpec> force_x{"force_x", "N", "force on the child, world axes"};
inline constexpr ChannelKind<JointSpec> force_y{"force_y", "N", "force on the child, world axes"};
inline constexpr ChannelKind<JointSpec> force_z{"force_z", "N", "force on the child, world axes"};
inline constexpr ChannelKind<JointSpec> moment_x{"moment_x", "N m", "moment on the child about the joint, world axes"};
inline constexpr ChannelKind<JointSpec> moment_y{"moment_y", "N m", "moment on the child about the joint, world axes"};
inline constexpr ChannelKind<JointSpec> moment_z{"moment_z", "N m", "moment on the child about the joint, world axes"};
inline constexpr std::array loads = {force_x, force_y, force_z, moment_x, moment_y, moment_z};
}  // namespace joint_channels

namespace sea_channels {
inline constexpr ChannelKind<SeaSpec> elevation_kind{"elevation", "m",
                                                     "undisturbed wave elevation at the world origin"};
inline const std::string elevation = elevation_kind.of("sea");
inline const std::string phase = "phase";  // index of the phase of the operation
}  // namespace sea_channels

}  // namespace stillhook
