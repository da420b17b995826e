#include "rendering/theme.hpp"

#include "common/check.hpp"

namespace swiftlet::rendering {
namespace {

constexpr Theme kLight{.unknown = rgb(0x7d8a98),
                       .free = rgb(0xffffff),
                       .wall = rgb(0x1c2733),
                       .behind_3d = rgb(0xe9edf1),
                       .grid = rgb(0x33475b).withAlpha(18),
                       .text = rgb(0x1c2733),
                       .trail = rgb(0x2461d3).withAlpha(235),
                       .plan = rgb(0x0a7f5f),
                       .goal = rgb(0xc2255c),
                       .home = rgb(0x5b3fb5),
                       .vehicle = rgb(0x1857c8),
                       .laser = rgb(0xc92020).withAlpha(225),
                       .level = rgb(0xb7791f)};

constexpr Theme kDark{.unknown = rgb(0x030406),
                      .free = rgb(0x56657a),
                      .wall = rgb(0xdfe7ef),
                      .behind_3d = rgb(0x12181f),
                      .grid = rgb(0xc8d7e6).withAlpha(16),
                      .text = rgb(0xf1f5f9),
                      .trail = rgb(0xb4d0ff).withAlpha(235),
                      .plan = rgb(0x4fe6b8),
                      .goal = rgb(0xffbbd5),
                      .home = rgb(0xd8cbff),
                      .vehicle = rgb(0xa8c8ff),
                      .laser = rgb(0xffc4bb).withAlpha(242),
                      .level = rgb(0xf7c873)};

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
      return light ? rgb(0x0b7fae) : rgb(0x8fe1ff);
    case common::FrontierReason::kTooSmall:
      return light ? rgb(0x5f6d7a) : rgb(0xc3ccd4);
    case common::FrontierReason::kUnreachable:
      return light ? rgb(0xcf4d06) : rgb(0xffc48c);
    case common::FrontierReason::kBlocked:
      return light ? rgb(0x2b8a3e) : rgb(0xb2f2bb);
    case common::FrontierReason::kOutOfBounds:
      return light ? rgb(0x9c36b5) : rgb(0xecb8fb);
    case common::FrontierReason::kBlacklisted:
      return light ? rgb(0xc92a2a) : rgb(0xffc0c0);
    case common::FrontierReason::kPositionUncertain:
      return light ? rgb(0x8f6f00) : rgb(0xffd84d);
  }
  SWIFTLET_CHECK(false, static_cast<int>(reason));
}

}  // namespace swiftlet::rendering
