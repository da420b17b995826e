// The numbers that a command line accepts.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace swiftlet::apps {

/// A finite number within the bounds. CLI11's own checks accept nan and show the largest double in messages.
CLI::Validator numberWithin(double low, double high);

/// Seeds are bounded, so that counting on from them does not overflow.
constexpr double kGreatestSeed = 1e9;

}  // namespace swiftlet::apps
