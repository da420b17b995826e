// The pieces the reports are made of.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/table.hpp"

namespace swiftlet::interfaces::html {

/// A link that stays inside the folder of the report: a relative path with special characters encoded.
std::string relativeUrl(std::string_view path);

/// "2026-11-21_14-03-55", as folders are named, as people write it: "2026-11-21 14:03:55"; anything else as it is.
std::string moment(std::string started);

/// A word on a coloured ground.
std::string pill(const std::string& text, common::Mark mark);

std::string section(const std::string& title, const std::string& body);

/// Small facts side by side: label and value.
std::string facts(const std::vector<std::pair<std::string, std::string>>& facts);

/// Plots, as many beside each other as fit.
std::string plots(const std::vector<std::string>& svg);

/// Scrolls sideways where the screen is narrow.
std::string table(const common::Table& table);

/// A whole document. `title` is escaped here, the others are HTML.
std::string page(const std::string& title, const std::string& header, const std::string& body);

}  // namespace swiftlet::interfaces::html
