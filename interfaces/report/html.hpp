// Building blocks of the reports.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/build_version.hpp"
#include "common/table.hpp"

namespace swiftlet::interfaces::html {

/// A link that stays inside the folder of the report: a relative path with special characters encoded.
std::string relativeUrl(std::string_view path);

/// Converts "2026-11-21_14-03-55", as in the names of folders, to "2026-11-21 14:03:55"; anything else is unchanged.
std::string moment(std::string started);

/// A word on a coloured background.
std::string pill(const std::string& text, common::Mark mark);

std::string section(const std::string& title, const std::string& body);

/// Small facts in a row, each with label and value.
std::string facts(const std::vector<std::pair<std::string, std::string>>& facts);

/// The section of the 3D map with its picture, a JPEG in base64; nothing without a picture.
std::string map3dSection(const std::string& jpeg_base64);

/// Plots, as many in a row as fit.
std::string plots(const std::vector<std::string>& svg);

/// Scrolls sideways on a narrow screen.
std::string table(const common::Table& table);

/// A whole document. `title` is escaped here; the other arguments are HTML.
std::string page(const std::string& title, const std::string& header, const std::string& body,
                 const common::BuildVersion& version);

}  // namespace swiftlet::interfaces::html
