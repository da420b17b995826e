// A tablet that watches the map: one HTTP connection that reads the MJPEG stream until it is told to stop.
#pragma once

#include <atomic>
#include <string>
#include <thread>

namespace swiftlet::flight {

class Tablet {
 public:
  /// Begins to watch /stream/map.mjpg on 127.0.0.1.
  explicit Tablet(int port);
  ~Tablet();
  Tablet(const Tablet&) = delete;
  Tablet& operator=(const Tablet&) = delete;

  int frames() const { return frames_; }

 private:
  void watch(int port);

  std::atomic<bool> stop_{false};
  std::atomic<int> frames_{0};
  std::thread thread_;
};

}  // namespace swiftlet::flight
