// The first files of a robot.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace stampede {

// A six-axis arm of plain shapes with two fingers, as a URDF to begin with.
std::string small_arm_urdf(std::string_view name);

// The Lua file that stands beside a URDF: the arm is all joints on the way to the fingers, which are two sliding joints
// of one link that move against each other, or else to the link that most joints move; the tip is between the fingers'
// ends; the arm starts with its hand pointing down in front of it where it can, else in the middle of its joints'
// ranges. Throws Error for a URDF that cannot be read or in which nothing turns or slides.
std::string robot_file(const std::filesystem::path& urdf);

}  // namespace stampede
