#include "tests/repository/source_tree.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace swiftlet::repository {
namespace {

Files readTrackedFiles() {
  const Answer listing = run("git -c safe.directory='*' ls-files --cached --others --exclude-standard");
  if (listing.exit_code != 0) throw std::runtime_error("git cannot list the files: " + listing.text);
  Files files;
  for (const std::string& path : linesOf(listing.text)) {
    std::ifstream stream(std::filesystem::path(SWIFTLET_SOURCE_DIR) / path, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (stream && text.find('\0') == std::string::npos) files.emplace(path, std::move(text));
  }
  return files;
}

/// A folder that may be used may be used with every room in it.
bool allows(const std::set<std::string>& uses, std::string folder) {
  while (!folder.empty() && !uses.contains(folder)) folder = folderOf(folder);
  return !folder.empty();
}

}  // namespace

const Files& trackedFiles() {
  static const Files files = readTrackedFiles();
  return files;
}

Answer run(const std::string& command) {
  const std::string line = "cd '" SWIFTLET_SOURCE_DIR "' && { " + command + "; } 2>&1";
  FILE* pipe = popen(line.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no shell");
  Answer answer;
  std::array<char, 4096> buffer;
  while (const std::size_t count = fread(buffer.data(), 1, buffer.size(), pipe))
    answer.text.append(buffer.data(), count);
  const int status = pclose(pipe);
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool endsWithAny(const std::string& path, const std::vector<std::string>& endings) {
  for (const std::string& ending : endings)
    if (path.ends_with(ending)) return true;
  return false;
}

std::string folderOf(const std::string& path) {
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash);
}

std::string topFolderOf(const std::string& path) {
  const auto slash = path.find('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

std::vector<Include> includesOf(const std::string& path, const std::string& text) {
  std::vector<Include> includes;
  int number = 0;
  for (const std::string& line : linesOf(text)) {
    ++number;
    if (!line.starts_with("#include \"")) continue;
    const auto begin = line.find('"') + 1;
    includes.push_back({path, number, line.substr(begin, line.find('"', begin) - begin)});
  }
  return includes;
}

Arrows readArrows(const std::string& page) {
  Arrows arrows;
  for (const std::string& line : linesOf(page)) {
    if (!line.starts_with("| `")) continue;
    const auto name_end = line.find('`', 3);
    const auto uses_begin = line.find('|', name_end) + 1;
    std::set<std::string>& uses = arrows[line.substr(3, name_end - 3)];
    std::istringstream stream(line.substr(uses_begin, line.find('|', uses_begin) - uses_begin));
    for (std::string word; std::getline(stream, word, ',');) {
      const auto first = word.find_first_not_of(' ');
      if (first == std::string::npos) continue;
      word = word.substr(first, word.find_last_not_of(' ') - first + 1);
      if (word != "-") uses.insert(word);
    }
  }
  return arrows;
}

std::string ownerOf(const std::string& path, const Arrows& arrows) {
  std::string folder = folderOf(path);
  while (!folder.empty() && !arrows.contains(folder)) folder = folderOf(folder);
  return folder;
}

std::vector<std::string> forbiddenArrows(const Files& files, const Arrows& arrows) {
  std::vector<std::string> found;
  for (const auto& [path, text] : files) {
    if (!endsWithAny(path, {".hpp", ".cpp"})) continue;
    const std::string from = ownerOf(path, arrows);
    if (from.empty()) continue;
    for (const Include& include : includesOf(path, text)) {
      const std::string to = ownerOf(include.target, arrows);
      const std::string place = path + ":" + std::to_string(include.line) + ": ";
      if (to.empty())
        found.push_back(place + "\"" + include.target + "\" is in no folder of the list, or not named from the root");
      else if (to != from && !allows(arrows.at(from), to))
        found.push_back(place + from + " may not use " + to);
    }
  }
  return found;
}

Arrows fileGraph(const Files& files) {
  Arrows graph;
  for (const auto& [path, text] : files)
    if (endsWithAny(path, {".hpp", ".cpp"}))
      for (const Include& include : includesOf(path, text))
        if (files.contains(include.target)) graph[path].insert(include.target);
  return graph;
}

std::vector<std::string> cycles(const Arrows& graph) {
  std::vector<std::string> found, trail;
  std::set<std::string> finished;
  const std::function<void(const std::string&)> visit = [&](const std::string& node) {
    for (auto at = trail.begin(); at != trail.end(); ++at) {
      if (*at != node) continue;
      std::string cycle;
      for (; at != trail.end(); ++at) cycle += *at + " -> ";
      found.push_back(cycle + node);
      return;
    }
    if (finished.contains(node)) return;
    trail.push_back(node);
    if (const auto next = graph.find(node); next != graph.end())
      for (const std::string& target : next->second) visit(target);
    trail.pop_back();
    finished.insert(node);
  };
  for (const auto& [node, targets] : graph) visit(node);
  return found;
}

std::vector<std::string> twoWayPairs(const Files& files) {
  const auto partOf = [](const std::string& path) { return path.substr(0, path.rfind('.')); };
  Arrows parts;
  for (const auto& [path, targets] : fileGraph(files))
    for (const std::string& target : targets) parts[partOf(path)].insert(partOf(target));
  std::vector<std::string> found;
  for (const auto& [part, targets] : parts)
    for (const std::string& target : targets)
      if (part < target && parts.contains(target) && parts.at(target).contains(part))
        found.push_back(part + " <-> " + target);
  return found;
}

}  // namespace swiftlet::repository
