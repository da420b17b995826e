// Ports: what a node type declares, what an XML attribute binds to it, and how a node reads and writes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "behaviors/tree/message.hpp"
#include "behaviors/tree/value.hpp"

namespace swiftlet::tree {

enum class Direction : unsigned char { kInput, kOutput, kInOut };

struct PortManifest {
  std::string name = {};  ///< Ends with its unit if it has one.
  PortType type = PortType::kString;
  Direction direction = Direction::kInput;
  bool required = false;
  std::optional<std::string> default_value = std::nullopt;  ///< Text, parsed like an attribute.
  std::optional<double> minimum = std::nullopt;             ///< Inclusive; numbers and durations (in the port's unit).
  std::optional<double> maximum = std::nullopt;
  std::string description = {};  ///< One sentence.
  /// The texts that are allowed, also by their numbers from 0; empty: any of the type.
  std::vector<std::string> choices = {};
  /// Of text that is a list with `;` between: the type of each element.
  std::optional<PortType> elements = std::nullopt;
  /// It waits for updates of an entry: text without braces is the name of one, too.
  bool names_entry = false;
  /// Of an output: the input with the list whose elements it writes, one after the other; empty for any other port.
  std::string element_of = {};
  /// Of an output: it takes the value of its entry away; without a slot if the entry is not of the node's own tree.
  bool unsets = false;
  /// A whole number of the node's children; negative ones count from the end, -1 is all of them.
  bool counts_children = false;
  /// Of text: it is SUCCESS, FAILURE, RUNNING or SKIPPED.
  bool names_status = false;
  /// Of a script: it is asked before a node starts and must not assign, because a Priority asks without starting it.
  bool asked = false;
};

/// The texts that a port allows; empty: any of its type.
const std::vector<std::string>& allowedTexts(const PortManifest& port);

/// "a number in metres from 0 to 5", for messages and documents; of an output "an entry for a number in metres".
std::string expectedOf(const PortManifest& port);

/// The value of `text` for this port, or what is wrong with it.
struct ReadValue {
  std::optional<Value> value;
  std::optional<Message> problem;
};
ReadValue readValue(const PortManifest& port, std::string_view text);

/// One blackboard entry. Subtrees that remap a name share the slot.
struct Slot {
  std::string name;
  std::size_t id = 0;  ///< Unique in its tree.
  std::optional<Value> value;
  /// The number that scripts see while the value is the text that a SubTree gives; nullopt otherwise.
  std::optional<Value> number_of_text;
  std::uint64_t writes = 0;  ///< How often it was written, for nodes that wait for updates.

  void write(Value next) {
    value = std::move(next);
    number_of_text.reset();
    ++writes;
  }
  /// The text that a SubTree gives: text for ports, for scripts a number if it is one.
  void give(const std::string& text) {
    write(text);
    number_of_text = numberOfText(text);
  }
  /// What `other` holds, with the number that scripts see of it.
  void copy(const Slot& other) {
    const std::optional<Value> number = other.number_of_text;
    write(*other.value);
    number_of_text = number;
  }
  /// Uses the memory of the text that it holds.
  void writeText(std::string_view text);
};

class Script;
struct Conditions;

/// The binding of a port of one node: a literal, a blackboard entry, a script, or nothing.
struct PortBinding {
  const PortManifest* manifest = nullptr;
  std::optional<Value> literal;
  Slot* slot = nullptr;
  Script* script = nullptr;  ///< Of a port of the type kScript; it belongs to the tree.
};

/// What a node is constructed from. It lives only during construction, so nodes copy what they need.
struct NodeSetup {
  std::string name;  ///< The attribute `name`, or the type.
  std::vector<PortBinding> ports;
  Conditions* conditions = nullptr;  ///< Null without any; they belong to the tree.
  /// The names of the registry that stand for numbers; null if there is no registry.
  const Constants* constants = nullptr;

  const PortBinding& port(std::string_view port_name) const;
};

/// A port read as T (std::string, double, std::int64_t, bool, Point, Points, Rectangle or Duration). A text entry is
/// parsed when it is read.
template <typename T>
class Input {
 public:
  /// The manifest must declare the port; it outlives the node (it lives in the registry).
  Input(const NodeSetup& setup, std::string_view port_name) : binding_(setup.port(port_name)) {}
  explicit Input(const PortBinding& binding) : binding_(binding) {}

  /// Given in the XML or by a default.
  bool given() const { return binding_.literal.has_value() || binding_.slot != nullptr; }
  /// Not read from an entry.
  bool fixed() const { return binding_.slot == nullptr; }
  /// Nothing if it is not given, if the entry is not set yet, or if its value does not fit this port.
  std::optional<T> get() const;
  /// Why get() returns nothing: "port goal: the entry {target} is not set".
  std::string problem() const;

 private:
  PortBinding binding_;
};

/// Why a node cannot read an input of any type now, as Input::problem() says; empty if it can, or if it is not given.
std::string readingProblem(const PortBinding& binding);

/// A port that is written.
class Output {
 public:
  Output(const NodeSetup& setup, std::string_view port_name) : binding_(setup.port(port_name)) {}
  /// Does nothing if the port is not given.
  void set(Value value) const {
    if (binding_.slot != nullptr) binding_.slot->write(std::move(value));
  }
  /// Sets what `entry` holds, which must have a value.
  void copy(const Slot& entry) const {
    if (binding_.slot != nullptr) binding_.slot->copy(entry);
  }

 private:
  PortBinding binding_;
};

}  // namespace swiftlet::tree
