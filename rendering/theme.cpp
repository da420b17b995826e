#include "rendering/theme.hpp"

#include "common/check.hpp"

namespace swiftlet::rendering {
namespace {

constexpr Theme kLight{.unknown = rgb(0xe3e7ec),
                       .free = rgb(0xffffff),
                       .wall = rgb(0x1c2733),
                       .grid = rgb(0x33475b).withAlpha(18),
                       .text = rgb(0x2b3947),
                       .trail = rgb(0x2f6fde).withAlpha(150),
                       .plan = rgb(0x0a8f6c).withAlpha(235),
                       .goal = rgb(0xc2255c),
                       .home = rgb(0x5b3fb5),
                       .vehicle = rgb(0x1857c8),
                       .laser = rgb(0xe03131).withAlpha(150),
                       .level = rgb(0xb7791f)};

constexpr Theme kDark{.unknown = rgb(0x12181f),
                      .free = rgb(0x26313d),
                      .wall = rgb(0xd5dee8),
                      .grid = rgb(0xc8d7e6).withAlpha(16),
                      .text = rgb(0xd5dee8),
                      .trail = rgb(0x6ea2ff).withAlpha(150),
                      .plan = rgb(0x3ddbab).withAlpha(235),
                      .goal = rgb(0xff6b9d),
                      .home = rgb(0xb197fc),
                      .vehicle = rgb(0x6ea2ff),
                      .laser = rgb(0xff7b7b).withAlpha(150),
                      .level = rgb(0xf0b44c)};

}  // namespace

std::optional<Scheme> schemeFrom(std::string_view word) {
  if (word == "light") return Scheme::kLight;
  if (word == "dark") return Scheme::kDark;
  return std::nullopt;
}

const Theme& themeOf(Scheme scheme) { return scheme == Scheme::kLight ? kLight : kDark; }

Color frontierColor(common::FrontierReason reason, Scheme scheme) {
  const bool light = scheme == Scheme::kLight;
  switch (reason) {
    case common::FrontierReason::kOpen:
      return light ? rgb(0x0b8fc4) : rgb(0x4cc9f0);
    case common::FrontierReason::kTooSmall:
      return rgb(0x8795a1);
    case common::FrontierReason::kUnreachable:
      return light ? rgb(0xe8590c) : rgb(0xff922b);
    case common::FrontierReason::kOutOfBounds:
      return light ? rgb(0x9c36b5) : rgb(0xda77f2);
    case common::FrontierReason::kBlacklisted:
      return light ? rgb(0xc92a2a) : rgb(0xff6b6b);
    case common::FrontierReason::kPositionUncertain:
      return light ? rgb(0xb08900) : rgb(0xffd43b);
  }
  SWIFTLET_CHECK(false, static_cast<int>(reason));
}

}  // namespace swiftlet::rendering
