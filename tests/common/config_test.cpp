// Configuration as users meet it: values over defaults, and mistakes explained.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config.hpp"
#include "common/error.hpp"
#include "common/vehicle_config.hpp"

namespace swiftlet::common {
namespace {

using testing::HasSubstr;

template <typename Config>
std::string problemsOf(const std::string& yaml) {
  Config config;
  try {
    config::YamlReader::fromText(yaml, "test.yaml").read(config);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Config, ReadsOverDefaults) {
  LaserConfig laser;
  config::YamlReader::fromText("rate_hz: 10\nsweep_s: 0.05\nmount: {z_m: 0.1}\n", "t").read(laser);
  EXPECT_EQ(laser.rate_hz, 10);
  EXPECT_EQ(laser.mount.z_m, 0.1);
  EXPECT_EQ(laser.beams, 1081);
}

TEST(Config, UnknownKeySaysWhereAndWhatWasMeant) {
  EXPECT_EQ(problemsOf<VehicleConfig>("mass_kg: 1.2\nhull_diametre_m: 0.5\n"),
            "test.yaml:2:1: unknown key `hull_diametre_m`, did you mean `hull_diameter_m`?");
}

TEST(Config, AKeyGivenTwiceIsSaid) {
  EXPECT_EQ(problemsOf<VehicleConfig>("mass_kg: 1.2\nhull_diameter_m: 0.5\nmass_kg: 1.6\n"),
            "test.yaml:3:1: key `mass_kg` is given twice");
}

TEST(Config, WrongTypeAndRangeAreReportedTogether) {
  const std::string text = problemsOf<LaserConfig>("beams: many\nrange_max_m: -3\nmount: {roll: 3}\n");
  EXPECT_THAT(text, HasSubstr("test.yaml:1:8: beams: `many` is not a whole number"));
  EXPECT_THAT(text, HasSubstr("test.yaml:2:14: range_max_m: -3 is not within"));
  EXPECT_THAT(text, HasSubstr("test.yaml:3:9: mount: unknown key `roll`, did you mean `roll_deg`?"));
}

TEST(Config, NumbersAtTheEndOfTheirRange) {
  EXPECT_THAT(problemsOf<LaserConfig>("beams: -2147483648\nmirror_first_beam: 1\n"), HasSubstr("beams: -2147483648"));
  EXPECT_THAT(problemsOf<VehicleConfig>("mass_kg: 1e400\n"), HasSubstr("`1e400` is not a number"));
  EXPECT_THAT(problemsOf<VehicleConfig>("mass_kg: .nan\n"), HasSubstr("mass_kg: nan is not within"));
  EXPECT_THAT(problemsOf<LaserConfig>("mount: {roll_deg: .nan}\n"), HasSubstr("roll_deg: nan is not within"));
}

TEST(Config, NotYamlAndMissingFile) {
  EXPECT_THAT(problemsOf<LaserConfig>("a: [1, 2"), HasSubstr("test.yaml:"));
  EXPECT_THROW(config::YamlReader::fromFile("/nowhere/x.yaml"), InputError);
  EXPECT_THAT(problemsOf<LaserConfig>("- 1\n- 2\n"), HasSubstr("a list where keys were expected"));
}

TEST(Config, PrintedConfigReadsBack) {
  LaserConfig laser;
  laser.rate_hz = 12.5;
  laser.name = "it's: \"odd\"";
  laser.mount.yaw_deg = -90;
  const std::string yaml = config::YamlPrinter(config::YamlPrinter::Comments::kYes).print(laser);
  LaserConfig back;
  config::YamlReader::fromText(yaml, "printed").read(back);
  EXPECT_EQ(back.rate_hz, 12.5);
  EXPECT_EQ(back.name, laser.name);
  EXPECT_EQ(back.mount.yaw_deg, -90);
}

}  // namespace
}  // namespace swiftlet::common
