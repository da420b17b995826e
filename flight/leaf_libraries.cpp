#include "flight/leaf_libraries.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <optional>
#include <utility>

#include "behaviors/leaf_library.hpp"
#include "common/error.hpp"

namespace swiftlet::flight {
namespace {

using common::Message;

constexpr const char* kEntry = "swiftlet_leaves";

[[noreturn]] void refuse(const std::string& file, const std::string& element, Message message, std::string hint) {
  throw common::InputError({file}, element, std::move(message), std::move(hint));
}

behaviors::LeafLibrary open(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    refuse(file, "--leaves", Message("file.missing", "no such file"), "");
  // An absolute path, because a name without a slash is searched for in the folders of the system.
  void* library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) refuse(file, "--leaves", Message("leaves.not-loaded", "cannot be loaded: {}", dlerror()), "");
  void* entry = dlsym(library, kEntry);
  if (entry == nullptr)
    refuse(file, "--leaves", Message("leaves.no-entry", "has no entry `{}`", kEntry),
           "behaviors/leaf_library.hpp shows what a library of leaves is made of");
  return reinterpret_cast<decltype(&swiftlet_leaves)>(entry)();
}

bool isName(const std::string& text) {
  return !text.empty() && !(text.front() >= '0' && text.front() <= '9') &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
         });
}

/// Why missions could not use the type as it describes itself; nullopt if they can.
std::optional<Message> problemOf(const tree::NodeManifest& leaf, const tree::Registry& known) {
  if (!isName(leaf.id)) return Message("leaf.name", "its name is not one of letters, digits and _");
  if (known.find(leaf.id) != nullptr || leaf.id == tree::subTreeManifest().id)
    return Message("leaf.known", "there is a node of that name");
  if (leaf.description.empty()) return Message("leaf.no-description", "its manifest has no description");
  tree::Constants numbers = known.constants();
  for (auto port = leaf.ports.begin(); port != leaf.ports.end(); ++port) {
    if (!isName(port->name))
      return Message("leaf.port-name", "its port `{}` is not named by letters, digits and _", port->name);
    if (leaf.findPort(port->name) != &*port)
      return Message("leaf.port-twice", "its port `{}` is declared twice", port->name);
    if (port->default_value)
      if (const tree::ReadValue value = readValue(*port, *port->default_value); !value.value)
        return Message("leaf.port-default", "its port `{}` has a default that it does not take: {}", port->name,
                       value.problem->text());
    for (std::size_t i = 0; i < port->choices.size(); ++i) {
      const auto number = static_cast<std::int64_t>(i);
      const std::int64_t known_number = numbers.emplace(tree::constantOf(port->choices[i]), number).first->second;
      if (known_number != number)
        return Message("leaf.port-choice", "its port `{}` has `{}` as number {}, which is {} in scripts", port->name,
                       port->choices[i], number, known_number);
    }
  }
  return std::nullopt;
}

tree::Registry leavesOf(const std::string& file) {
  const behaviors::LeafLibrary library = open(file);
  const std::string release = library.release == nullptr ? "" : library.release;
  if (release != behaviors::leafRelease())
    refuse(
        file, "--leaves",
        Message("leaves.other-release", "is built for Swiftlet {}, and this is {}", release, behaviors::leafRelease()),
        "build it against the installed libraries of this one");
  if (library.layout != behaviors::kLeafLayout)
    refuse(file, "--leaves",
           Message("leaves.other-headers", "is built with other headers than this program, though of the same release"),
           "build it against the installed libraries of this one");
  tree::Registry leaves;
  try {
    if (library.add != nullptr) library.add(leaves);
  } catch (const std::exception& error) {
    refuse(file, kEntry, Message("leaves.failed", "{}", error.what()), "");
  }
  if (leaves.types().empty())
    refuse(file, kEntry, Message("leaves.none", "adds no leaf"), "leaves.add<MyLeaf>() adds one");
  return leaves;
}

}  // namespace

behaviors::NodeTypes nodesWith(const std::vector<std::string>& libraries) {
  tree::Registry nodes = behaviors::missionRegistry();
  for (const std::string& file : libraries) {
    const tree::Registry leaves = leavesOf(file);
    for (const auto& [id, type] : leaves.types()) {
      if (const auto problem = problemOf(type.manifest, nodes)) refuse(file, id, *problem, "");
      nodes.add(type.manifest, type.build);
    }
  }
  return std::make_shared<const tree::Registry>(std::move(nodes));
}

}  // namespace swiftlet::flight
