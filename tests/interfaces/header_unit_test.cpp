// Units that the headers of clouds name in comments, and comments that only look so.
#include "interfaces/files/header_unit.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace swiftlet::interfaces {
namespace {

TEST(HeaderUnit, IsFoundInAnyForm) {
  for (const auto& [comment, metres] : {std::pair{" units: centimeters", 0.01},
                                        {" unit: mm", 0.001},
                                        {" inches", 0.0254},
                                        {" units=millimeter", 0.001},
                                        {"# Units: FEET", 0.3048},
                                        {" length_unit = \"cm\"", 0.01},
                                        {" coordinate units are in mm", 0.001},
                                        {" units: in", 0.0254},
                                        {" metres", 1.0},
                                        {" unit_of_length km", 1000.0}}) {
    const auto unit = unitIn(comment);
    ASSERT_TRUE(unit) << comment;
    EXPECT_EQ(unit->metres, metres) << comment;
  }
  EXPECT_EQ(unitIn(" unit: MilliMetres")->word, "MilliMetres");
}

TEST(HeaderUnit, IsNotGuessedFromOtherTexts) {
  for (const char* comment :
       {"", "#", " made in house by m", " in", " m", " scanned at 5 m", " voxels of 5 centimeters",
        " the community of meters", " units: arbitrary", " VCGLIB generated"})
    EXPECT_FALSE(unitIn(comment)) << comment;
}

}  // namespace
}  // namespace swiftlet::interfaces
