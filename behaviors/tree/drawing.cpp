#include "behaviors/tree/drawing.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "behaviors/tree/node_manifest.hpp"
#include "behaviors/tree/xml_text.hpp"

namespace swiftlet::tree {
namespace {

// Pixels.
constexpr int kMargin = 12, kRow = 26, kIndent = 26, kSign = 18, kGap = 8;
/// Width of a letter at most, on average over a text: fonts differ, and wide ones are common.
constexpr int kLetter = 9;
constexpr std::size_t kMostLetters = 110;

struct Look {
  const char* sign;
  const char* color;
};

Look lookOf(const NodeRecord& record) {
  if (record.manifest == nullptr) return {"\u25B8", "#64748b"};
  const std::string_view id = record.manifest->id;
  switch (record.manifest->kind) {
    case NodeKind::kControl:
      if (id == "Priority") return {"!", "#b91c1c"};
      if (id.starts_with("Parallel")) return {"\u21C9", "#1d4ed8"};
      return {id.find("Fallback") != std::string_view::npos ? "?" : "\u2192", "#1d4ed8"};
    case NodeKind::kDecorator:
      return {"\u25C7", "#7c3aed"};
    case NodeKind::kCondition:
      return {"\u2713", "#a16207"};
    case NodeKind::kAction:
      return {"\u25CF", "#15803d"};
  }
  return {"", "#000000"};
}

/// Cut between two characters of UTF-8.
std::string shortened(const std::string& text) {
  std::size_t end = kMostLetters;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + " ...";
}

class Drawing {
 public:
  explicit Drawing(const Tree& tree) : tree_(tree), depths_(tree.nodes().size()) {}

  std::string draw() {
    for (const NodeRecord& record : tree_.nodes()) row(record);
    const int height = 2 * kMargin + kRow * static_cast<int>(tree_.nodes().size());
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" font-family=\"sans-serif\" "
        "font-size=\"13\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n{2}</svg>\n",
        width_, height, text_);
  }

 private:
  static int xOf(int depth) { return kMargin + depth * kIndent; }
  static int yOf(int row) { return kMargin + row * kRow; }

  void row(const NodeRecord& record) {
    const int id = record.node->id();
    const int depth = record.parent < 0 ? 0 : depths_[static_cast<std::size_t>(record.parent)] + 1;
    depths_[static_cast<std::size_t>(id)] = depth;
    const int x = xOf(depth), middle = yOf(id) + kRow / 2;
    if (record.parent >= 0) connect(xOf(depth - 1) + kSign / 2, yOf(record.parent) + kRow / 2 + kSign / 2, x, middle);
    const Look look = lookOf(record);
    text_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"4\" fill=\"{}\"/>\n", x,
                         middle - kSign / 2, kSign, kSign, look.color);
    text(x + kSign / 2, middle, look.sign, " fill=\"#ffffff\" text-anchor=\"middle\"");
    words(record, x + kSign + kGap, middle);
  }

  /// One text, in which the viewer sets the second part behind the first: only it knows how wide its letters are.
  void words(const NodeRecord& record, int x, int middle) {
    const std::string& name = record.node->name();
    std::string more;
    if (record.manifest != nullptr && record.manifest->id != name) more = record.manifest->id;
    for (const PortView& port : tree_.portsOf(record.node->id()))
      if (port.name != "ID" || port.value != name)
        more += (more.empty() ? "" : "  ") + port.name + "=" +
                (port.entry.empty() ? port.value.value_or("") : "{" + port.entry + "}");
    if (more.size() > kMostLetters) more = shortened(more);
    std::string shown = fmt::format("<tspan fill=\"#0f172a\" font-weight=\"bold\">{}</tspan>", escaped(name));
    if (!more.empty()) shown += fmt::format("<tspan dx=\"{}\" fill=\"#475569\">{}</tspan>", kGap, escaped(more));
    text(x, middle, shown, "");
    width_ = std::max(width_, x + kLetter * static_cast<int>(name.size() + more.size()) + kGap + kMargin);
  }

  void connect(int from_x, int from_y, int to_x, int to_y) {
    text_ += fmt::format("<path d=\"M{} {}V{}H{}\" fill=\"none\" stroke=\"#94a3b8\"/>\n", from_x, from_y, to_y, to_x);
  }

  void text(int x, int middle, const std::string& content, const std::string& style) {
    text_ += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", x, middle + 5, style, content);
  }

  const Tree& tree_;
  std::vector<int> depths_;  ///< By node id.
  int width_ = 0;
  std::string text_;
};

}  // namespace

std::string drawTree(const Tree& tree) { return Drawing(tree).draw(); }

}  // namespace swiftlet::tree
