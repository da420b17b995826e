// What the cameras see on surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/random.hpp"
#include "fixtures.hpp"
#include "simulation/appearance/covering.hpp"
#include "simulation/sensors/surface_shader.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using test_support::ProblemIs;
using test_support::problemsOf;
using testing::ElementsAre;

TEST(Texture, IsTheColourOfTheSurfaceOrItsOwn) {
  const Color color(0.2F, 0.4F, 0.6F);
  EXPECT_TRUE(Texture(2, std::vector<Texel>(4)).on(color, 0.3F, 0.7F, 0.0F).isApprox(color, 1e-5F));
  const Texture paint(2, std::vector<Texel>(4, {255, 0, 51, 255}));
  EXPECT_TRUE(paint.on(color, 0.3F, 0.7F, 0.0F).isApprox(Color(1.0F, 0.0F, 0.2F), 1e-5F));
}

TEST(Texture, RepeatsAndBlendsNeighbours) {
  std::vector<Texel> texels(16);
  texels[5] = {255, 255, 255, 255};  // Column 1, row 1.
  const Texture texture(4, texels);
  const Color black = Color::Zero();
  EXPECT_NEAR(texture.on(black, 1.5F / 4, 1.5F / 4, 0.0F).x(), 1.0F, 1e-5F);
  EXPECT_NEAR(texture.on(black, 1.5F / 4 - 3.0F, 1.5F / 4 + 2.0F, 0.0F).x(), 1.0F, 1e-4F);
  EXPECT_NEAR(texture.on(black, 2.0F / 4, 1.5F / 4, 0.0F).x(), 0.5F * (0.5F + 0.5F * 128 / 255), 0.3F) << "half way";
  EXPECT_NEAR(texture.on(black, 3.5F / 4, 3.5F / 4, 0.0F).x(), 0.0F, 1e-5F);
}

// From afar a pixel sees the mean of what it covers, wherever it looks.
TEST(Texture, FromAfarIsTheMeanOfItsTexels) {
  std::vector<Texel> texels(64 * 64);
  for (std::size_t i = 0; i < texels.size(); ++i)
    if ((i % 64 + i / 64) % 2 == 0) texels[i] = {0, 0, 0, 0};
  const Texture checkered(64, texels);
  const Color white = Color::Ones();
  for (const float u : {0.1F, 0.33F, 0.7F}) EXPECT_NEAR(checkered.on(white, u, 0.2F, 0.5F).x(), 0.5F, 0.02F);
  EXPECT_LT(checkered.on(white, 0.5F / 64, 0.5F / 64, 0.0F).x(), 0.01F);
}

double contrastOf(Pattern pattern) {
  const Texture texture = makePattern(pattern, 0);
  double sum = 0.0, squares = 0.0;
  constexpr int kSamples = 20'000;
  common::RandomStream random(1, "samples");
  for (int i = 0; i < kSamples; ++i) {
    const auto u = static_cast<float>(random.uniform()), v = static_cast<float>(random.uniform());
    const double grey = texture.on(Color::Constant(0.5F), u, v, 0.0F).mean();
    sum += grey;
    squares += grey * grey;
  }
  const double mean = sum / kSamples;
  EXPECT_NEAR(mean, 0.5, 0.08) << "keeps the colour of the surface";
  return std::sqrt(squares / kSamples - mean * mean);
}

TEST(Patterns, HaveStructureButForPlasterWhichIsFaint) {
  EXPECT_LT(contrastOf(Pattern::kPlaster), 0.03);
  EXPECT_GT(contrastOf(Pattern::kPlaster), 0.005);
  for (const Pattern pattern : {Pattern::kWood, Pattern::kBrick, Pattern::kCarpet, Pattern::kTiles, Pattern::kPosters})
    EXPECT_GT(contrastOf(pattern), 0.04) << patternWords()[static_cast<std::size_t>(pattern)];
}

TEST(Patterns, HaveTheirWords) {
  EXPECT_EQ(patternFrom("brick"), Pattern::kBrick);
  EXPECT_EQ(patternFrom("posters"), Pattern::kPosters);
  EXPECT_EQ(patternFrom("brik"), std::nullopt);
}

TEST(Covering, IsDrawnFromTheNameUnlessTheMaterialNamesIt) {
  std::set<Pattern> walls;
  int blank_ceilings = 0;
  for (int i = 0; i < 60; ++i) {
    const Shape wall = boxShape("wall_" + std::to_string(i), {0, 0, 0}, {4.0, 0.1, 2.5});
    walls.insert(coveringOf(wall).side);
    EXPECT_EQ(coveringOf(wall).side, coveringOf(wall).side);
    blank_ceilings += coveringOf(wall).down == Pattern::kBlank ? 1 : 0;
    EXPECT_NE(coveringOf(wall).up, Pattern::kBlank) << "a floor has structure";
  }
  EXPECT_TRUE(walls.contains(Pattern::kBlank) && walls.contains(Pattern::kPosters));
  EXPECT_GT(blank_ceilings, 25);
  Shape named = boxShape("wall_1", {0, 0, 0}, {4.0, 0.1, 2.5});
  named.pattern = Pattern::kTiles;
  EXPECT_EQ(coveringOf(named).down, Pattern::kTiles);
}

TEST(Covering, MovesWithItsModel) {
  WorldModel world = boxRoom();
  world.shapes.push_back(boxShape("box", {1.0, 1.0, 0.0}, {1.5, 1.5, 1.0}));
  world.shapes.back().pattern = Pattern::kBrick;
  const auto seen = [&](const Eigen::Vector3d& from) {
    const RayCaster rays(world);
    const Ray ray{from.cast<float>(), Eigen::Vector3f::UnitX()};
    return SurfaceShader(world).see(ray, rays.cast(from, Eigen::Vector3d::UnitX(), 10.0), 0.001F, {}).light;
  };
  const Color before = seen({0.5, 1.21, 0.43}), elsewhere = seen({0.5, 1.21, 0.475});
  world.moveModel("box", {0.31, -0.17});
  EXPECT_TRUE(seen({0.81, 1.04, 0.43}).isApprox(before, 1e-3F));
  EXPECT_FALSE(elsewhere.isApprox(before, 0.05F)) << "the pattern must tell places apart";
}

const char* const kWorldWithTexture = R"(<?xml version="1.0"?>
<sdf version="1.9" xmlns:swiftlet="swiftlet">
  <world name="w"><model name="wall"><static>true</static><link name="body">
    <visual name="v"><geometry><box><size>1 1 1</size></box></geometry>
      <material><diffuse>0.5 0.5 0.5 1</diffuse><swiftlet:texture>TEXTURE</swiftlet:texture></material>
    </visual></link></model></world>
</sdf>)";

std::string withTexture(const std::string& word) {
  std::string text = kWorldWithTexture;
  return text.replace(text.find("TEXTURE"), 7, word);
}

TEST(WorldTextures, AreNamedInTheMaterial) {
  const TemporaryFolder folder("world_textures");
  const WorldModel world = loadWorld(folder.write("w.sdf", withTexture("brick")));
  EXPECT_EQ(world.shapes.at(0).pattern, Pattern::kBrick);
  EXPECT_THAT(world.warnings, testing::IsEmpty()) << "other readers, and this one, take the element as it is";
}

TEST(WorldTextures, AMirrorIsNamedAsOne) {
  const TemporaryFolder folder("world_textures");
  const WorldModel world = loadWorld(folder.write("w.sdf", withTexture("mirror")));
  EXPECT_TRUE(world.shapes.at(0).mirror);
  EXPECT_FALSE(loadWorld(folder.write("w.sdf", withTexture("brick"))).shapes.at(0).mirror);
}

TEST(WorldTextures, AnUnknownOneIsRefusedWithItsLine) {
  const TemporaryFolder folder("world_textures");
  const std::string file = folder.write("w.sdf", withTexture("brik"));
  EXPECT_THAT(problemsOf([&] { loadWorld(file); }), ElementsAre(ProblemIs("world.no-texture", "w.sdf:5", "`brick`")));
}

}  // namespace
}  // namespace swiftlet::simulation
