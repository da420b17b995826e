// The work of `swiftlet evaluate` after its command line was read.
#pragma once

#include <map>
#include <string>

#include "evaluation/trajectory_metrics.hpp"

namespace swiftlet::apps {

struct EvaluateOptions {
  std::string estimate;
  std::string against;  ///< File of the relations or of the reference.
  bool allow_missing = false;
  double max_difference_s = 0.01;
  std::string align = "spatial";  ///< A key of kAlignments.
  bool scale = false;
  double delta = 1.0;
  std::string unit = "frames";  ///< A key of kUnits.
  bool json = false;
};

inline const std::map<std::string, evaluation::Alignment> kAlignments = {{"none", evaluation::Alignment::kNone},
                                                                         {"first", evaluation::Alignment::kFirstPose},
                                                                         {"planar", evaluation::Alignment::kPlanar},
                                                                         {"spatial", evaluation::Alignment::kSpatial}};
inline const std::map<std::string, evaluation::Stretch::Unit> kUnits = {
    {"frames", evaluation::Stretch::Unit::kFrames},
    {"seconds", evaluation::Stretch::Unit::kSeconds},
    {"metres", evaluation::Stretch::Unit::kMetres}};

/// Each prints its figures and returns the exit code. Throws InputError for files and options that cannot be used.
int evaluateRelations(const EvaluateOptions& options);
int evaluateAte(const EvaluateOptions& options);
int evaluateRpe(const EvaluateOptions& options);

}  // namespace swiftlet::apps
