// Addresses of Gazebo Fuel under each scheme that worlds use.
#include "simulation/fuel_address.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/uri_resolver.hpp"

namespace swiftlet::simulation {
namespace {

TEST(FuelAddress, IsTheSameUnderEachScheme) {
  for (const std::string scheme : {"https", "http", "fuel", "FUEL"}) {
    const auto address =
        fuelAddress(scheme + "://fuel.gazebosim.org/1.0/OpenRobotics/models/Oak%20Tree/2/files/meshes/t.obj");
    ASSERT_TRUE(address) << scheme;
    EXPECT_EQ(address->server, "fuel.gazebosim.org");
    EXPECT_EQ(address->owner, "OpenRobotics");
    EXPECT_EQ(address->name, "Oak Tree");
    EXPECT_EQ(address->version, "2");
    EXPECT_EQ(address->inside, "meshes/t.obj");
  }
  for (const char* other : {"model://a/b/models/c", "httpx://a/b/models/c", "fuel.gazebosim.org/o/models/m"})
    EXPECT_FALSE(fuelAddress(other)) << other;
}

TEST(FuelAddress, IsDownloadedTheSameWayUnderEachScheme) {
  const UriResolver resolver("w.sdf", {});
  for (const std::string scheme : {"https", "fuel"})
    EXPECT_THAT(resolver.hintFor(scheme + "://fuel.gazebosim.org/1.0/o/models/No Such Model/meshes/m.dae", ""),
                testing::HasSubstr("`gz fuel download -u \"https://fuel.gazebosim.org/1.0/o/models/No Such Model\"`"));
}

}  // namespace
}  // namespace swiftlet::simulation
