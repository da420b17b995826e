// The word that a mistyped one most likely means.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/error.hpp"

namespace swiftlet::common {
namespace {

std::string hintFor(const std::string& word, const std::vector<std::string>& candidates) {
  return didYouMean(word, candidates);
}

TEST(SimilarWords, MayDifferInTheCaseOfEveryLetter) {
  EXPECT_EQ(hintFor("P", {"q", "p"}), "did you mean `p`?");
  EXPECT_EQ(hintFor("COLLISION", {"link", "collision"}), "did you mean `collision`?");
  EXPECT_EQ(hintFor("P", {"q", "r"}), "");
}

TEST(SimilarWords, MayDifferInWhatIsNotSeen) {
  EXPECT_EQ(hintFor("p\u200B", {"q", "p"}), "did you mean `p`?");
  EXPECT_EQ(hintFor("p", {"q", "p\u200B"}), "did you mean `p\u200B`, which has a zero-width space (U+200B)?");
}

}  // namespace
}  // namespace swiftlet::common
