// Classes stay small enough to be read: at most 15 data members and 20 public methods, pure data at most 25 members.
#include "tests/repository/class_sizes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/repository/source_tree.hpp"

namespace swiftlet::repository {
namespace {

TEST(ClassSizes, CountMembersMethodsAndWhatIsNested) {
  const auto sizes = classSizes(R"(
namespace a {
/// A comment with a member; int no_;
class Counted final : public Base {
 public:
  explicit Counted(int a) : a_(a) {}
  Counted(const Counted&) = delete;
  ~Counted() override;
  int one() const { return a_; }
  std::optional<std::map<int, int>> two(double x = 0.0, int y = {1}) const;
  bool operator==(const Counted&) const = default;

 private:
  struct Inner {
    int a = 0, b = 0;
    std::string c = "x;y";
  };
  static constexpr int kNone = 3;
  void hidden();
  int a_ = 0;
  std::map<int, std::vector<int>> b_{{1, {2}}};
  std::optional<Inner> inner_;
  std::function<void(int)> f_;
};
struct Data {
  int a;
  double b = 1.0;
};
})");
  ASSERT_EQ(sizes.size(), 2U);
  EXPECT_EQ(sizes[0].members, 6);
  EXPECT_EQ(sizes[0].public_methods, 2);
  EXPECT_EQ(sizes[1].members, 2);
}

TEST(ClassSizes, AreThoseThatCanBeRead) {
  constexpr int kMostMembers = 15, kMostMethods = 20, kMostData = 25;
  for (const auto& [path, text] : trackedFiles()) {
    const std::string top = topFolderOf(path);
    if (!path.ends_with(".hpp") || top == "tests" || top == "fuzz" || top == "benchmarks") continue;
    for (const ClassSize& size : classSizes(text)) {
      const bool is_data = size.is_struct;
      EXPECT_LE(size.members, is_data ? kMostData : kMostMembers)
          << path << ": " << size.name << " has too many members";
      EXPECT_LE(size.public_methods, kMostMethods) << path << ": " << size.name << " has too many public methods";
    }
  }
}

}  // namespace
}  // namespace swiftlet::repository
