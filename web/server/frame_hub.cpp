#include "web/server/frame_hub.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rendering/canvas.hpp"
#include "rendering/resize.hpp"

namespace swiftlet::web {
namespace {

/// JPEG qualities: lines and text of a map show artefacts sooner than photographs, for which 75 is the usual default.
constexpr int kMapQuality = 85;
constexpr int kCameraQuality = 75;

rendering::MapView mapView(const PictureView& asked) {
  rendering::MapView view;
  view.width_px = asked.width_px;
  view.height_px = asked.height_px;
  view.scheme = asked.scheme;
  return view;
}

/// What a stream shows before there is a picture.
common::Image notice(int width_px, int height_px, rendering::Scheme scheme, std::string_view text) {
  const rendering::Theme& theme = rendering::themeOf(scheme);
  common::Image image{width_px, height_px, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(width_px) * height_px);
  rendering::Canvas canvas(std::move(image));
  canvas.fillRect(0.0, 0.0, width_px, height_px, theme.unknown);
  canvas.text(text, {0.5 * width_px, 0.5 * height_px}, std::max(6.0, width_px / 32.0), theme.text,
              rendering::Align::kCenter);
  return canvas.take();
}

}  // namespace

std::shared_ptr<FrameHub::View> FrameHub::watch(const PictureView& asked) {
  std::erase_if(views_, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<View>& known = views_[asked];
  std::shared_ptr<View> view = known.lock();
  if (!view) known = view = std::make_shared<View>(asked);
  return view;
}

std::shared_ptr<const StreamFrame> FrameHub::frame(View& view, const std::shared_ptr<const StreamFrame>& last,
                                                   common::Duration period, common::Time sent) {
  const common::Time now = telemetry_.now();
  const std::uint64_t newest =
      view.asked_.source == PictureView::Source::kMap ? telemetry_.world().sequence : telemetry_.camera().sequence;
  // A watcher that comes between the ticks of the others gets their picture, unless it is older than its own period.
  const bool due = view.frame_ && now - view.frame_->encoded_unix_time >= least_period_ &&
                   view.frame_->source_sequence != newest &&
                   (view.frame_ == last || now - view.frame_->encoded_unix_time > period);
  if (!view.frame_ || due) {
    view.frame_ = encode(view, now);
    view.cost_s_ = std::clamp((telemetry_.now() - now).seconds(), 0.0,
                              1.0);  // The clock may have been set, so the time is bounded.
    shareTime();
  }
  if (view.frame_ != last || now - sent > common::Duration::fromMilliseconds(1000)) return view.frame_;
  return nullptr;
}

/// Half of the thread's time is kept for everything else, so that Hold and Land never wait for pictures. With many
/// views of different sizes each is drawn less often.
void FrameHub::shareTime() {
  constexpr double kShareOfThread = 0.5;
  double total_s = 0.0;
  for (const auto& [asked, known] : views_)
    if (const auto view = known.lock()) total_s += view->cost_s_;
  least_period_ = common::Duration::fromSeconds(total_s / kShareOfThread);
}

std::shared_ptr<const StreamFrame> FrameHub::encode(View& view, common::Time now) {
  const PictureView& asked = view.asked_;
  auto frame = std::make_shared<StreamFrame>();
  rendering::Bytes jpeg;
  common::Time stamp, seen = now;
  if (asked.source == PictureView::Source::kMap) {
    const auto& world = telemetry_.world();
    frame->source_sequence = world.sequence;
    if (world.value) {
      stamp = world.value->stamp;
      seen = world.unix_time;
    }
    jpeg = jpeg_.encode(
        world.value ? view.renderer_.render(rendering::pictureOf(*world.value, hull_diameter_m_), mapView(asked))
                    : notice(asked.width_px, asked.height_px, asked.scheme, "waiting for the first map"),
        kMapQuality);
  } else {
    const auto& camera = telemetry_.camera();
    frame->source_sequence = camera.sequence;
    const bool whole = camera.value && camera.value->image.width_px > 0 && camera.value->image.height_px > 0;
    if (whole) {
      stamp = camera.value->stamps.measured;
      seen = camera.unix_time;
    }
    jpeg = jpeg_.encode(
        whole ? rendering::shrinkToWidth(camera.value->image, asked.width_px)
              : notice(asked.width_px, asked.width_px * 3 / 4, rendering::Scheme::kDark, "waiting for the camera"),
        kCameraQuality);
  }
  frame->encoded_unix_time = now;
  frame->bytes = fmt::format(
      "Content-Type: image/jpeg\r\nContent-Length: {}\r\nX-Timestamp: {:.6f}\r\nX-Flight-Time: {:.6f}\r\n\r\n",
      jpeg.size(), seen.seconds(), stamp.seconds());
  frame->bytes.append(jpeg.begin(), jpeg.end());
  frame->bytes += fmt::format("\r\n--{}\r\n", kStreamBoundary);
  return frame;
}

rendering::Bytes FrameHub::png(const PictureView& view) const {
  return rendering::encodePng(
      rendering::renderMap(rendering::pictureOf(*telemetry_.world().value, hull_diameter_m_), mapView(view)));
}

}  // namespace swiftlet::web
