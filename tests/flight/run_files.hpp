// The files of a run as other people's tools read them: plain readers of their own, so that a mistake in ours shows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swiftlet::flight {

/// One line of a TUM trajectory: stamp, position, quaternion x y z w.
struct TumPose {
  double stamp_s = 0.0;
  double position_m[3] = {};
  double quaternion[4] = {};
};
/// The complete lines of the file; a line that does not hold eight numbers fails the test.
std::vector<TumPose> readTum(const std::filesystem::path& file);

struct Pgm {
  int width_px = 0;
  int height_px = 0;
  int greatest = 0;
  std::string pixels;  ///< Row by row from the top.
};
/// A binary graymap (P5); what is none fails the test.
Pgm readPgm(const std::filesystem::path& file);

/// All that must hold of the files of any run, finished or cut short.
void expectSoundRun(const std::filesystem::path& run);

}  // namespace swiftlet::flight
