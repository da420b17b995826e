// Independent readers of the files of a run, so that a mistake of Swiftlet's own readers is found.
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
/// The complete lines of the file; a line without eight numbers fails the test.
std::vector<TumPose> readTum(const std::filesystem::path& file);

struct Pgm {
  int width_px = 0;
  int height_px = 0;
  int greatest = 0;
  std::string pixels;  ///< Row by row from the top.
};
/// A binary graymap (P5); any other file fails the test.
Pgm readPgm(const std::filesystem::path& file);

/// The conditions for the files of every run, finished or interrupted.
void expectSoundRun(const std::filesystem::path& run);

}  // namespace swiftlet::flight
