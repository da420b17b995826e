// Relations between the poses of a recorded log, as the benchmark of Kuemmerle et al. writes them (On measuring the
// accuracy of SLAM algorithms, Autonomous Robots 2009): `t1 t2 x y z roll pitch yaw`, seconds, metres, radians; t1 and
// t2 are stamps of the log with six decimals, x to yaw is the pose at t2 as seen from the pose at t1.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/trajectory.hpp"

namespace swiftlet::interfaces {

/// Relations in the order of the file, plain or compressed. Blank lines and comments (`#`) are left out. Throws
/// InputError with file, line and column for any other line that is not a relation.
std::vector<common::Relation> readRelations(const std::filesystem::path& file);
/// Messages use `name` as the file.
std::vector<common::Relation> parseRelations(std::string_view text, const std::string& name);

}  // namespace swiftlet::interfaces
