// Pictures on surfaces: textures of meshes, and albedo maps of a world's materials.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <string>

#include "common/png_encoder.hpp"
#include "fixtures.hpp"
#include "simulation/sensors/surface_shader.hpp"

namespace swiftlet::simulation {
namespace {

enum Corner { kRed, kGreen, kBlue, kWhite, kElse };

/// Red and green above, blue and white below.
void writePicture(const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  constexpr int kSide = 64;
  std::vector<std::uint8_t> rgb;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const bool right = column >= kSide / 2, below = row >= kSide / 2;
      const std::array<std::uint8_t, 3> color =
          below ? (right ? std::array<std::uint8_t, 3>{255, 255, 255} : std::array<std::uint8_t, 3>{0, 0, 255})
                : (right ? std::array<std::uint8_t, 3>{0, 255, 0} : std::array<std::uint8_t, 3>{255, 0, 0});
      rgb.insert(rgb.end(), color.begin(), color.end());
    }
  const std::vector<std::uint8_t> png = common::encodePng(common::Image{kSide, kSide, std::move(rgb)});
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
}

/// What a camera at x = -3 sees ahead at that place.
Corner seenAt(const WorldModel& world, double y_m, double z_m) {
  const RayCaster rays(world);
  const Eigen::Vector3d from(-3.0, y_m, z_m);
  const Hit hit = rays.cast(from, Eigen::Vector3d::UnitX(), 10.0);
  EXPECT_TRUE(hit);
  const Color light = SurfaceShader(world).see({from.cast<float>(), Eigen::Vector3f::UnitX()}, hit, 0.003F, {}).light;
  const bool red = light.x() > 0.2F, green = light.y() > 0.2F, blue = light.z() > 0.2F;
  if (red && green && blue) return kWhite;
  if (red && !green && !blue) return kRed;
  if (green && !red && !blue) return kGreen;
  if (blue && !red && !green) return kBlue;
  return kElse;
}

const char* const kObj =
    "mtllib wall.mtl\nv 0 0.5 0\nv 0 -0.5 0\nv 0 -0.5 1\nv 0 0.5 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl paper\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

std::string worldOf(const std::string& geometry, const std::string& material) {
  return "<sdf version=\"1.9\"><world name=\"w\"><model name=\"m\"><static>true</static><link name=\"l\"><visual "
         "name=\"v\">"
         "<geometry>" +
         geometry + "</geometry>" + material + "</visual></link></model></world></sdf>";
}

TEST(SurfaceImages, AMeshShowsTheTextureOfItsMaterial) {
  const TemporaryFolder folder("surface_images");
  folder.write("wall.obj", kObj);
  folder.write("wall.mtl", "newmtl paper\nKd 0.5 0.5 0.5\nmap_Kd pictures/wall.png\n");
  writePicture(folder.path() / "pictures/wall.png");
  const WorldModel world = loadWorld(folder.write("w.sdf", worldOf("<mesh><uri>wall.obj</uri></mesh>", "")));
  // From x = -3 the left of the picture is at greater y.
  EXPECT_EQ(seenAt(world, 0.25, 0.75), kRed);
  EXPECT_EQ(seenAt(world, -0.25, 0.75), kGreen);
  EXPECT_EQ(seenAt(world, 0.25, 0.25), kBlue);
  EXPECT_EQ(seenAt(world, -0.25, 0.25), kWhite);
}

TEST(SurfaceImages, WithoutItsFileOrWithADamagedOneAMeshHasItsColour) {
  const TemporaryFolder folder("surface_images");
  folder.write("wall.obj", kObj);
  folder.write("wall.mtl", "newmtl paper\nKd 0.9 0.05 0.05\nmap_Kd wall.png\n");
  const std::string file = folder.write("w.sdf", worldOf("<mesh><uri>wall.obj</uri></mesh>", ""));
  EXPECT_EQ(seenAt(loadWorld(file), -0.25, 0.25), kRed);
  folder.write("wall.png", "\x89PNG\r\n\x1a\nnothing more");
  EXPECT_EQ(seenAt(loadWorld(file), -0.25, 0.25), kRed);
}

TEST(SurfaceImages, TheMaterialOfTheWorldReplacesThatOfTheMesh) {
  const TemporaryFolder folder("surface_images");
  folder.write("wall.obj", kObj);
  folder.write("wall.mtl", "newmtl paper\nKd 0.5 0.5 0.5\nmap_Kd wall.png\n");
  writePicture(folder.path() / "wall.png");
  const std::string blue = "<material><diffuse>0.02 0.02 0.9 1</diffuse></material>";
  const WorldModel world = loadWorld(folder.write("w.sdf", worldOf("<mesh><uri>wall.obj</uri></mesh>", blue)));
  EXPECT_EQ(seenAt(world, 0.25, 0.75), kBlue);
}

TEST(SurfaceImages, AnAlbedoMapIsStretchedOverEachSideOfABox) {
  const TemporaryFolder folder("surface_images");
  writePicture(folder.path() / "box.png");
  const std::string material =
      "<material><diffuse>1 1 1 1</diffuse><pbr><metal><albedo_map>box.png</albedo_map></metal></pbr></material>";
  const WorldModel world = loadWorld(folder.write("w.sdf", worldOf("<box><size>0.4 2 3</size></box>", material)));
  EXPECT_EQ(seenAt(world, -0.7, 1.2), kRed);
  EXPECT_EQ(seenAt(world, 0.7, 1.2), kGreen);
  EXPECT_EQ(seenAt(world, -0.7, -1.2), kBlue);
  EXPECT_EQ(seenAt(world, 0.7, -1.2), kWhite);
}

TEST(SurfaceImages, AnImageOfAnyShapeBecomesATexture) {
  const common::Image image{3, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255}};
  const Texture texture = Texture::of(image);
  const Color left = texture.on(Color::Ones(), 0.13F, 0.5F, 0.0F),
              right = texture.on(Color::Ones(), 0.875F, 0.5F, 0.0F);
  EXPECT_NEAR(left.x(), 1.0F, 0.05F);
  EXPECT_NEAR(right.z(), 1.0F, 0.05F);
}

}  // namespace
}  // namespace swiftlet::simulation
