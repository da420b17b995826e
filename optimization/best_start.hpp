// Pose graphs whose guess may be far off: the lowest chi2 of several starts, by one rule for all graphs.
//
//   chordal start -> optimize --- chi2 fell by less than 4 times, and the guess was no better ---> done
//                                 else: from the guess, and from both with a robust kernel that widens; the best
//
// Where the noise is that of real sensors the chordal start lies in the basin of the best solution, and its own chi2
// shows it: on random graphs of rotations up to 0.7 rad off, no other start beat it where chi2 fell less than 6 times,
// and on those of the usual data sets it falls by at most 2.6. Beyond that the robust kernel found the lowest chi2 most
// often.
#pragma once

#include "optimization/pose_graph_2d.hpp"
#include "optimization/pose_graph_3d.hpp"

namespace swiftlet::optimization {

enum class Start { kGuess, kChordal, kRobustChordal, kRobustGuess };
const char* toString(Start start);

struct BestStartConfig {
  int max_iterations = 100;          ///< Greatest number for each start.
  double relative_decrease = 1e-10;  ///< Converged when chi2 changes by less than this share.
};

template <typename Pose>
struct BestStartSolution {
  std::vector<Pose> poses;
  double chi2_guess = 0.0;
  double chi2 = 0.0;
  Start start = Start::kChordal;  ///< Where the solution came from.
  int starts = 0;                 ///< Number of starts that were tried.
  int iterations = 0;             ///< Sum over all starts.
  bool converged = false;         ///< Whether the start that the solution came from did.
};

/// chi2 is the sum of e' * information * e; no edge is robust here, whatever it says. It is never above that of the
/// guess. Of several poses that no edge connects to a fixed one, the first stays. Indices must be valid. Deterministic;
/// one thread.
BestStartSolution<common::Pose2> optimizeFromBestStart(PoseGraph2D graph, const BestStartConfig& config);
BestStartSolution<common::Pose3> optimizeFromBestStart(PoseGraph3D graph, const BestStartConfig& config);

}  // namespace swiftlet::optimization
