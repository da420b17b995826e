// What numbers a command line takes.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace swiftlet::apps {

/// A finite number within the bounds; CLI11's own checks let nan through and name the largest double.
CLI::Validator numberWithin(double low, double high);

/// Seeds leave room to count on from them.
constexpr double kGreatestSeed = 1e9;

}  // namespace swiftlet::apps
