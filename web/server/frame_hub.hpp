// Pictures for the streams: each watched view is drawn and encoded once for all its watchers.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/jpeg_encoder.hpp"
#include "rendering/map3d_renderer.hpp"
#include "rendering/map_renderer.hpp"
#include "web/server/picture_view.hpp"
#include "web/server/telemetry.hpp"

namespace swiftlet::web {

/// One part of a multipart stream: its headers, the JPEG and the boundary that follows. The boundary is sent with the
/// picture it ends, because browsers show a picture only after reading it.
struct StreamFrame {
  std::string bytes;
  std::uint64_t source_sequence = 0;
  common::Time encoded_unix_time;
};

inline constexpr const char* kStreamBoundary = "swiftlet-frame";

class FrameHub {
 public:
  FrameHub(Telemetry& telemetry, double hull_diameter_m) : telemetry_(telemetry), hull_diameter_m_(hull_diameter_m) {}

  /// A watcher of a view. The caches of the view live until its last watcher is gone.
  class View;
  std::shared_ptr<View> watch(const PictureView& view);

  /// A client that watches a view at a rate, and the frame that was sent last; null before the first.
  struct Watcher {
    std::shared_ptr<const StreamFrame> last = nullptr;
    common::Duration period;
    common::Time sent = {};
    bool by_operator = false;
  };

  /// Whether a new picture is to be drawn for the watcher: the source has changed, and the views of all watchers, for
  /// an operator those of operators, leave time for it.
  bool due(const View& view, const Watcher& watcher) const;
  /// Draws and encodes the view's next frame. Returns the time that it took, at most a second.
  common::Duration draw(View& view, const Watcher& watcher);
  /// The frame to send to the watcher: the view's frame if it has another one, or after a second without change (so
  /// that a client can tell silence from a broken link); otherwise null.
  std::shared_ptr<const StreamFrame> frame(const View& view, const Watcher& watcher) const;

  /// A single picture as PNG. A world must have been seen.
  std::vector<std::uint8_t> png(const PictureView& view) const;

 private:
  /// A picture and the times that its part of the stream says.
  struct Drawn {
    std::vector<std::uint8_t> jpeg;
    common::Time stamp;  ///< Time of the flight.
    common::Time seen;   ///< When the server first saw the source, since 1970.
  };

  common::Duration since(common::Time then) const;
  std::shared_ptr<const StreamFrame> encode(View& view, common::Time now);
  /// Rises when there is something new to show.
  std::uint64_t newest(PictureView::Source source) const;
  Drawn drawn(View& view, common::Time now);
  Drawn drawMap(View& view, common::Time now);
  Drawn drawCamera(const PictureView& asked, common::Time now);
  Drawn drawMap3d(View& view, common::Time now);
  Drawn drawDepth(const PictureView& asked, common::Time now);
  void shareTime();

  Telemetry& telemetry_;
  double hull_diameter_m_;
  common::JpegEncoder jpeg_;
  std::map<PictureView, std::weak_ptr<View>> views_;
  /// Least period between two pictures of a view, so that all views together use a bounded share of the time.
  common::Duration least_period_;
  common::Duration least_period_for_operator_;  ///< The same for the views that were drawn for operators.
};

class FrameHub::View {
 public:
  explicit View(const PictureView& asked) : asked_(asked) {}

 private:
  friend class FrameHub;
  PictureView asked_;
  rendering::MapRenderer renderer_;
  rendering::Map3dRenderer renderer3d_;
  std::shared_ptr<const StreamFrame> frame_;
  double cost_s_ = 0.0;        ///< Time to draw its last picture.
  bool for_operator_ = false;  ///< Its last picture was.
};

}  // namespace swiftlet::web
