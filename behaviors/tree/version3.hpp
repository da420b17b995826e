// How a file of BehaviorTree.CPP 3 differs from one of version 4, and the edits that make it one of
// version 4. Most of the language is the same in both; a file without BTCPP_format is recognized by the differences.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/document.hpp"

namespace swiftlet::tree {

/// Replaces the bytes of a text from `begin` to `end` (exclusive).
struct Edit {
  std::size_t begin = 0, end = 0;
  std::string text;
};

/// One use of the language that differs in version 4.
struct Version3Use {
  const XmlElement* element = nullptr;
  std::size_t offset = 0;  ///< Of the element, or of the attribute that it is about.
  Message message;         ///< "`SequenceStar` is of version 3, version 4 writes `SequenceWithMemory`".
  /// Both versions can read it, with another meaning: the attribute of a <SubTree> without braces.
  bool readable = false;
  std::vector<Edit> edits;
  /// Version 4 cannot express it: the name of an entry that no script can hold.
  bool rewritable = true;
};

/// In the order of the file. BTCPP_format is not among them.
std::vector<Version3Use> version3Uses(const Document& document);

/// Whether it uses a node or an attribute that version 3 does not have.
bool usesVersion4(const Document& document);

/// The text with all edits carried out. They must not overlap.
std::string edited(std::string_view text, std::vector<Edit> edits);

}  // namespace swiftlet::tree
