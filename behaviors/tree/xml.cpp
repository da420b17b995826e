#include "behaviors/tree/xml.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include <expat.h>
#include <fmt/core.h>

#include "behaviors/tree/characters.hpp"
#include "behaviors/tree/encoding.hpp"
#include "behaviors/tree/escaped_text.hpp"

namespace swiftlet::tree {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";
constexpr std::string_view kHtml = "html";
constexpr std::string_view kCommentBegin = "<!--", kCommentEnd = "-->";

/// Elements around those whose depth is limited: <root> and <BehaviorTree>.
constexpr int kOuterLevels = 2;

class Reader {
 public:
  /// Reads the escaped text in place of the source.
  Reader(const SourceText& source, int max_depth, const EscapedText& escaped)
      : source_(source), max_depth_(max_depth), escaped_(escaped), text_(escaped.text()) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), onOpen, onClose);
    XML_SetCharacterDataHandler(parser_.get(), onText);
    XML_SetStartDoctypeDeclHandler(parser_.get(), onDoctype);
  }

  XmlResult read() {
    XmlResult result;
    if (constexpr std::size_t kMost = std::numeric_limits<int>::max(); text_.size() > kMost) {
      result.problem = Problem{{source_.file()}, {}, fileTooLarge(source_.file(), kMost)};
      return result;
    }
    if (const std::string_view wide = wideEncoding(text_); !wide.empty()) {
      result.problem = Problem{{source_.file(), 1, 1},
                               {},
                               Message("tree.file-wide", "the file begins as {} does, but is not in it", wide),
                               "save it as UTF-8"};
      return result;
    }
    const XML_Status status = XML_Parse(parser_.get(), text_.data(), static_cast<int>(text_.size()), XML_TRUE);
    if (problem_)
      result.problem = std::move(problem_);
    else if (status != XML_STATUS_OK)
      result.problem = malformed();
    else
      result.root = std::move(root_);
    return result;
  }

 private:
  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  static void onOpen(void* self, const XML_Char* name, const XML_Char** attributes) {
    static_cast<Reader*>(self)->open(name, attributes);
  }
  static void onClose(void* self, const XML_Char*) { static_cast<Reader*>(self)->close(); }
  static void onText(void* self, const XML_Char* text, int length) {
    static_cast<Reader*>(self)->text({text, static_cast<std::size_t>(length)});
  }
  static void onDoctype(void* self, const XML_Char* name, const XML_Char*, const XML_Char*, int) {
    if (isHtml(name)) return static_cast<Reader*>(self)->stopAtHtml();
    static_cast<Reader*>(self)->stop("<!DOCTYPE>", Message("tree.xml-doctype", "a DOCTYPE is not supported"),
                                     "take it out, and write its entities as the text they stand for");
  }

  static bool isHtml(std::string_view name) {
    return std::equal(name.begin(), name.end(), kHtml.begin(), kHtml.end(),
                      [](char c, char low) { return (c | 0x20) == low; });
  }

  /// Of HTML in small letters, which XML does not have.
  bool beginsWithHtmlDoctype() const {
    constexpr std::string_view kDoctype = "<!doctype ";
    const std::string& text = source_.text();
    const std::size_t at = text.find(kDoctype);
    return at == text.find_first_not_of(kXmlBlanks) && at != std::string::npos &&
           isHtml(std::string_view(text).substr(at + kDoctype.size(), kHtml.size()));
  }

  Problem htmlPage() const {
    return {source_.locate(offset()),
            {},
            Message("tree.html-page", "this is an HTML page, not a file of trees"),
            "download the file itself, which GitHub shows by `Raw`"};
  }

  void stopAtHtml() {
    Problem problem = htmlPage();
    stop({}, std::move(problem.message), std::move(problem.hint));
  }

  void open(const XML_Char* name, const XML_Char** attributes) {
    if (problem_) return;
    if (open_.empty() && isHtml(name)) return stopAtHtml();
    if (static_cast<int>(open_.size()) >= max_depth_ + kOuterLevels) {
      stop(name, Message("tree.elements-deep", "elements are nested deeper than {}", max_depth_), "take levels out");
      return;
    }
    XmlElement& element = open_.empty() ? root_.emplace() : open_.back().element->children.emplace_back();
    element.name = name;
    element.offset = offset();
    element.attributes.reserve(static_cast<std::size_t>(XML_GetSpecifiedAttributeCount(parser_.get())) / 2);
    for (; *attributes != nullptr; attributes += 2) element.attributes.push_back({attributes[0], attributes[1]});
    const std::size_t tag_end = readOffset() + static_cast<std::size_t>(XML_GetCurrentByteCount(parser_.get()));
    open_.push_back({&element, text_.compare(tag_end - 2, 2, "/>") == 0});
  }

  void close() {
    if (!open_.back().closes_itself) open_.back().element->close_offset = offset();
    open_.pop_back();
  }

  void text(std::string_view text) {
    if (problem_ || open_.empty()) return;
    if (text.find(kCommentEnd) != std::string_view::npos && !stray_end_) stray_end_ = offset();
    if (open_.back().element->text_offset) return;
    const std::size_t first = text.find_first_not_of(kXmlBlanks);
    if (first != std::string_view::npos) open_.back().element->text_offset = offset() + first;
  }

  void stop(std::string element, Message message, std::string hint) {
    if (problem_) return;
    problem_ = Problem{source_.locate(offset()), std::move(element), std::move(message), std::move(hint)};
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  Problem malformed() const {
    const XML_Error code = XML_GetErrorCode(parser_.get());
    const std::string& text = source_.text();
    if (code == XML_ERROR_INVALID_TOKEN && offset() < text.size() && characterLength(text, offset()) == 0)
      return wrongEncoding();
    if (beginsWithHtmlDoctype()) return htmlPage();
    if (code == XML_ERROR_TAG_MISMATCH && stray_end_)
      if (auto problem = strayCommentEnd(source_, *stray_end_)) return *problem;
    return {source_.locate(offset()), open_.empty() ? std::string() : "<" + open_.back().element->name + ">",
            Message("tree.xml-malformed", "malformed XML: {}{}", XML_ErrorString(code), strangerAt(code)),
            remedyFor(code)};
  }

  /// " at U+201C (left double quotation mark)": where expat stopped, if that is no plain sign of ASCII.
  std::string strangerAt(XML_Error code) const {
    const std::string& text = source_.text();
    const bool token =
        code == XML_ERROR_INVALID_TOKEN || code == XML_ERROR_JUNK_AFTER_DOC_ELEMENT || code == XML_ERROR_SYNTAX;
    if (!token || offset() >= text.size()) return {};
    const auto first = static_cast<unsigned char>(text[offset()]);
    return first >= 0x20 && first < 0x7F ? "" : " at " + nameOfCharacter(text, offset());
  }

  /// Empty for rare errors and those that need no explanation.
  std::string remedyFor(XML_Error code) const {
    const bool about_itself = code == XML_ERROR_UNCLOSED_TOKEN || code == XML_ERROR_MISPLACED_XML_PI;
    if (!about_itself && source_.text().find('<') >= offset()) return "a file begins with <root BTCPP_format=\"4\">";
    switch (code) {
      case XML_ERROR_INVALID_TOKEN:
        return remedyForToken();
      case XML_ERROR_DUPLICATE_ATTRIBUTE:
        return "give it once";
      case XML_ERROR_TAG_MISMATCH:
      case XML_ERROR_NO_ELEMENTS:
        return open_.empty() ? std::string() : closingOf(*open_.back().element);
      case XML_ERROR_UNDEFINED_ENTITY:
        return "XML has &amp; &lt; &gt; &quot; and &apos; alone, write any other character itself";
      case XML_ERROR_BAD_CHAR_REF:
        return "XML does not allow this character, take it out";
      case XML_ERROR_UNCLOSED_TOKEN:
        return "what begins here has no end";
      case XML_ERROR_UNCLOSED_CDATA_SECTION:
        return "]]> ends it";
      case XML_ERROR_JUNK_AFTER_DOC_ELEMENT:
        return "only comments may follow </root>";
      case XML_ERROR_MISPLACED_XML_PI:
        return "<?xml ...?> stands at the very beginning, or not at all";
      default:
        return {};
    }
  }

  std::string closingOf(const XmlElement& element) const {
    return fmt::format("<{0}> was opened at line {1}, and </{0}> closes it", element.name,
                       source_.locate(element.offset).line);
  }

  /// By what is written where expat stopped, or just before; empty if that is no clue.
  std::string remedyForToken() const {
    const std::string& text = source_.text();
    const std::size_t at = offset();
    const auto isAt = [&](std::size_t place, char c) { return place < text.size() && text[place] == c; };
    if (isAt(at, '&') || (at > 0 && isAt(at - 1, '&'))) return "write & as &amp;";
    if (isAt(at, '<')) return remedyForTagWithin();
    if (text.substr(at < 3 ? 0 : at - 3, 4).find("<!") != std::string::npos)
      return "a comment is written as <!-- text -->";
    if (at > 0 && isAt(at - 1, '=')) return "put the value in quotes";
    if (at < text.size() && static_cast<unsigned char>(text[at]) < 0x20U)
      return "XML does not allow this control character, take it out";
    return {};
  }

  /// At a `<` before the end of a tag.
  std::string remedyForTagWithin() const {
    const std::size_t at = readOffset();
    char quote = '\0';
    for (std::size_t i = at == 0 ? 0 : text_.rfind('<', at - 1); i < at; ++i) {
      if (quote == '\0' && (text_[i] == '"' || text_[i] == '\''))
        quote = text_[i];
      else if (text_[i] == quote)
        quote = '\0';
    }
    if (quote != '\0') return "in a value, write < as &lt;";
    if (text_.compare(at, kCommentBegin.size(), kCommentBegin) == 0)
      return "a comment stands between two tags, move it out of this one";
    return "the tag before has no > at its end";
  }

  /// At a byte that is no UTF-8.
  Problem wrongEncoding() const {
    const std::string declared(declaredEncoding(source_.text()));
    return {source_.locate(offset()),
            {},
            Message("tree.not-utf-8", "a byte that is not UTF-8{}{}",
                    declared.empty() ? "" : ", in a file that says it is ", declared),
            fmt::format("`iconv -f WINDOWS-1252 -t UTF-8 {} > NEW.xml` converts a file of Western Europe; name its "
                        "encoding if it is another",
                        source_.file())};
  }

  /// Of what expat reads now, in the source.
  std::size_t offset() const { return escaped_.originalOffset(readOffset()); }

  std::size_t readOffset() const {
    const XML_Index index = XML_GetCurrentByteIndex(parser_.get());
    return index < 0 ? 0 : static_cast<std::size_t>(index);
  }

  const SourceText& source_;
  int max_depth_;
  const EscapedText& escaped_;
  const std::string& text_;  ///< What expat reads.
  // The encoding is fixed so that byte offsets are those of the text.
  std::unique_ptr<XML_ParserStruct, Free> parser_{XML_ParserCreate("UTF-8")};
  std::optional<XmlElement> root_;
  // Descends into the last child. Elements do not move while one of their children is open.
  struct Open {
    XmlElement* element = nullptr;
    bool closes_itself = false;  ///< <Element/>
  };
  std::vector<Open> open_;
  std::optional<std::size_t> stray_end_;  ///< Of the first text that holds the end of a comment.
  std::optional<Problem> problem_;
};

}  // namespace

const XmlAttribute* XmlElement::find(std::string_view attribute_name) const {
  for (const XmlAttribute& attribute : attributes)
    if (attribute.name == attribute_name) return &attribute;
  return nullptr;
}

const std::string* XmlElement::attribute(std::string_view attribute_name) const {
  const XmlAttribute* found = find(attribute_name);
  return found == nullptr ? nullptr : &found->value;
}

Message fileTooLarge(const std::string& file, std::size_t most_bytes) {
  return Message("tree.file-large", "`{}` is larger than {} bytes", file, most_bytes);
}

std::optional<Problem> strayCommentEnd(const SourceText& source, std::size_t from) {
  const std::string_view text = source.text();
  const std::size_t at = text.find(kCommentEnd, from);
  if (at == std::string_view::npos || text.substr(from, at - from).find('<') != std::string_view::npos)
    return std::nullopt;
  const std::size_t before = text.substr(0, at).rfind(kCommentEnd);
  const bool ended = before != std::string_view::npos &&
                     text.substr(before, at - before).find(kCommentBegin) == std::string_view::npos;
  return Problem{source.locate(at), "-->",
                 ended ? Message("tree.comment-ended", "the comment before has ended at the --> in line {} already",
                                 source.locate(before).line)
                       : Message("tree.comment-unopened", "no comment begins before it"),
                 "a comment ends at its first -->, take the others and <!-- within it out"};
}

XmlResult parseXml(const SourceText& source, int max_depth, bool lenient) {
  const EscapedText escaped(source.text(), lenient);
  XmlResult result = Reader(source, max_depth, escaped).read();
  result.unescaped = escaped.found();
  return result;
}

}  // namespace swiftlet::tree
