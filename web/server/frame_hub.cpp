#include "web/server/frame_hub.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/png_encoder.hpp"
#include "common/world/map3d_layer.hpp"
#include "rendering/canvas.hpp"
#include "rendering/depth_picture.hpp"
#include "rendering/resize.hpp"

namespace swiftlet::web {
namespace {

/// JPEG qualities: lines and text of a map show artefacts sooner than photographs, for which 75 is the usual default.
constexpr int kMapQuality = 85;
constexpr int kCameraQuality = 75;

/// Longer than any period between pictures.
constexpr common::Duration kLongAgo = common::Duration::fromMilliseconds(3'600'000);

constexpr const char* kNoMapYet = "waiting for the first map";
constexpr const char* kNoCamera = "this flight has no RGB-D camera";

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

common::Image mapNotice(const PictureView& asked, std::string_view text) {
  return notice(asked.width_px, asked.height_px, asked.scheme, text);
}

common::Image cameraNotice(const PictureView& asked, std::string_view text) {
  return notice(asked.width_px, asked.width_px * 3 / 4, rendering::Scheme::kDark, text);
}

rendering::Map3dView map3dView(const PictureView& asked) {
  return {asked.width_px, asked.height_px, asked.scheme, asked.coloring, asked.viewpoint};
}

}  // namespace

std::shared_ptr<FrameHub::View> FrameHub::watch(const PictureView& asked) {
  std::erase_if(views_, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<View>& known = views_[asked];
  std::shared_ptr<View> view = known.lock();
  if (!view) known = view = std::make_shared<View>(asked);
  return view;
}

/// Times ahead are from before the clock was set back: they count as long ago, so that no client waits for them.
common::Duration FrameHub::since(common::Time then) const {
  const common::Duration age = telemetry_.now() - then;
  return age < common::Duration{} ? kLongAgo : age;
}

/// A watcher that comes between the ticks of the others gets their picture, unless it is older than its own period.
bool FrameHub::due(const View& view, const Watcher& watcher) const {
  if (!view.frame_) return true;
  const common::Duration age = since(view.frame_->encoded_unix_time);
  return age >= (watcher.by_operator ? least_period_for_operator_ : least_period_) &&
         view.frame_->source_sequence != newest(view.asked_.source) &&
         (view.frame_ == watcher.last || age > watcher.period);
}

common::Duration FrameHub::draw(View& view, const Watcher& watcher) {
  const common::Time now = telemetry_.now();
  view.frame_ = encode(view, now);
  // The clock may have been set, so the time is bounded.
  view.cost_s_ = std::clamp((telemetry_.now() - now).seconds(), 0.0, 1.0);
  view.for_operator_ = watcher.by_operator;
  shareTime();
  return common::Duration::fromSeconds(view.cost_s_);
}

std::shared_ptr<const StreamFrame> FrameHub::frame(const View& view, const Watcher& watcher) const {
  const bool silent = since(watcher.sent) > common::Duration::fromMilliseconds(1000);
  return view.frame_ != watcher.last || silent ? view.frame_ : nullptr;
}

/// Half of the thread's time is kept for everything else, so that Hold and Land never wait for pictures. With many
/// views of different sizes each is drawn less often; those of operators do not wait for those of viewers.
void FrameHub::shareTime() {
  constexpr double kShareOfThread = 0.5;
  double total_s = 0.0, for_operator_s = 0.0;
  for (const auto& [asked, known] : views_) {
    const auto view = known.lock();
    if (!view) continue;
    total_s += view->cost_s_;
    if (view->for_operator_) for_operator_s += view->cost_s_;
  }
  least_period_ = common::Duration::fromSeconds(total_s / kShareOfThread);
  least_period_for_operator_ = common::Duration::fromSeconds(for_operator_s / kShareOfThread);
}

std::uint64_t FrameHub::newest(PictureView::Source source) const {
  const auto& world = telemetry_.world();
  switch (source) {
    case PictureView::Source::kMap:
      return world.sequence;
    case PictureView::Source::kCamera:
      return telemetry_.camera().sequence;
    case PictureView::Source::kMap3d:
      // A flight without a 3D map shows one notice, whose number is 1.
      return !world.value ? 0 : !world.value->map3d ? 1 : world.sequence + 1;
    case PictureView::Source::kDepth:
      return telemetry_.depth().sequence;
  }
  SWIFTLET_CHECK(false, static_cast<int>(source));
}

std::shared_ptr<const StreamFrame> FrameHub::encode(View& view, common::Time now) {
  auto frame = std::make_shared<StreamFrame>();
  frame->source_sequence = newest(view.asked_.source);
  const auto [jpeg, stamp, seen] = drawn(view, now);
  frame->encoded_unix_time = now;
  frame->bytes = fmt::format(
      "Content-Type: image/jpeg\r\nContent-Length: {}\r\nX-Timestamp: {:.6f}\r\nX-Flight-Time: {:.6f}\r\n\r\n",
      jpeg.size(), seen.seconds(), stamp.seconds());
  frame->bytes.append(jpeg.begin(), jpeg.end());
  frame->bytes += fmt::format("\r\n--{}\r\n", kStreamBoundary);
  return frame;
}

FrameHub::Drawn FrameHub::drawn(View& view, common::Time now) {
  switch (view.asked_.source) {
    case PictureView::Source::kMap:
      return drawMap(view, now);
    case PictureView::Source::kCamera:
      return drawCamera(view.asked_, now);
    case PictureView::Source::kMap3d:
      return drawMap3d(view, now);
    case PictureView::Source::kDepth:
      return drawDepth(view.asked_, now);
  }
  SWIFTLET_CHECK(false, static_cast<int>(view.asked_.source));
}

FrameHub::Drawn FrameHub::drawMap(View& view, common::Time now) {
  const PictureView& asked = view.asked_;
  const auto& world = telemetry_.world();
  if (!world.value) return {jpeg_.encode(mapNotice(asked, kNoMapYet), kMapQuality), {}, now};
  const rendering::MapPicture picture = rendering::pictureOf(*world.value, hull_diameter_m_);
  return {jpeg_.encode(view.renderer_.render(picture, mapView(asked)), kMapQuality), world.value->stamp,
          world.unix_time};
}

FrameHub::Drawn FrameHub::drawCamera(const PictureView& asked, common::Time now) {
  const auto& camera = telemetry_.camera();
  if (!camera.value || camera.value->image.width_px <= 0 || camera.value->image.height_px <= 0)
    return {jpeg_.encode(cameraNotice(asked, "waiting for the camera"), kCameraQuality), {}, now};
  return {jpeg_.encode(rendering::shrinkToWidth(camera.value->image, asked.width_px), kCameraQuality),
          camera.value->stamps.measured, camera.unix_time};
}

FrameHub::Drawn FrameHub::drawMap3d(View& view, common::Time now) {
  const PictureView& asked = view.asked_;
  const auto& world = telemetry_.world();
  if (!world.value || !world.value->map3d)
    return {jpeg_.encode(mapNotice(asked, world.value ? kNoCamera : kNoMapYet), kCameraQuality), {}, now};
  const rendering::Picture3d picture = rendering::picture3dOf(*world.value, hull_diameter_m_);
  return {jpeg_.encode(view.renderer3d_.render(picture, map3dView(asked)), kCameraQuality), world.value->stamp,
          world.unix_time};
}

FrameHub::Drawn FrameHub::drawDepth(const PictureView& asked, common::Time now) {
  const auto& depth = telemetry_.depth();
  const auto& world = telemetry_.world().value;
  const bool camera = !world || (world->map3d && world->map3d->frame);
  if (!depth.value || depth.value->depth.width_px <= 0 || depth.value->depth.height_px <= 0)
    return {jpeg_.encode(cameraNotice(asked, camera ? "waiting for the camera" : kNoCamera), kCameraQuality), {}, now};
  return {jpeg_.encode(rendering::depthPicture(depth.value->depth, asked.width_px), kCameraQuality),
          depth.value->stamps.measured, depth.unix_time};
}

std::vector<std::uint8_t> FrameHub::png(const PictureView& view) const {
  return common::encodePng(
      rendering::renderMap(rendering::pictureOf(*telemetry_.world().value, hull_diameter_m_), mapView(view)));
}

}  // namespace swiftlet::web
