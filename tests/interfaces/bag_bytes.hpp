// Bags for tests, byte by byte.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <archive.h>
#include <archive_entry.h>

namespace swiftlet::interfaces::bag_bytes {

inline std::string u32(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}
inline std::string f32(float value) { return u32(std::bit_cast<std::uint32_t>(value)); }
inline std::string text(const std::string& value) { return u32(static_cast<std::uint32_t>(value.size())) + value; }

struct Field {
  std::string name, value;
};

inline std::string fields(const std::vector<Field>& all) {
  std::string bytes;
  for (const Field& field : all) bytes += text(field.name + "=" + field.value);
  return bytes;
}
inline std::string record(char op, std::vector<Field> header, const std::string& data) {
  header.push_back({"op", std::string(1, op)});
  return text(fields(header)) + text(data);
}

/// The beginning of a bag: without a number of chunks as a killed writer leaves it, with one as a finished writer
/// leaves it.
inline std::string begin(std::uint32_t chunks = 0) {
  const std::string index_pos = u32(chunks == 0 ? 0 : 4096) + u32(0);
  return "#ROSBAG V2.0\n" + record(3, {{"index_pos", index_pos}, {"conn_count", u32(1)}, {"chunk_count", u32(chunks)}},
                                   std::string(64, ' '));
}

inline std::string connection(std::uint32_t id, const std::string& topic, const std::string& type,
                              const std::string& md5 = "90c7ef2dc6895d81024acba2ac42f369") {
  return record(7, {{"conn", u32(id)}, {"topic", topic}},
                fields({{"topic", topic}, {"type", type}, {"md5sum", md5}, {"message_definition", "none"}}));
}

inline std::string message(std::uint32_t id, std::uint32_t second, const std::string& data) {
  return record(2, {{"conn", u32(id)}, {"time", u32(second) + u32(0)}}, data);
}

struct Fan {
  float first_rad = -1.0F, step_rad = 0.5F, range_min_m = 0.1F, range_max_m = 5.0F;
  std::uint32_t second = 7;
};

inline std::string scan(const std::vector<float>& ranges, const Fan& fan = {}) {
  std::string data = u32(1) + u32(fan.second) + u32(500'000'000) + text("laser");
  for (const float value : {fan.first_rad, 1.0F, fan.step_rad, 1e-4F, 0.1F, fan.range_min_m, fan.range_max_m})
    data += f32(value);
  data += u32(static_cast<std::uint32_t>(ranges.size()));
  for (const float range : ranges) data += f32(range);
  return data + u32(0);
}

/// Compresses the bytes like a chunk.
inline std::string packed(const std::string& plain, const std::string& by) {
  if (by == "none") return plain;
  std::string bytes(plain.size() + 100'000, '\0');
  std::size_t used = 0;
  struct archive* writer = archive_write_new();
  archive_write_add_filter_by_name(writer, by == "bz2" ? "bzip2" : "lz4");
  archive_write_set_format_raw(writer);
  archive_write_set_bytes_in_last_block(writer, 1);
  archive_write_open_memory(writer, bytes.data(), bytes.size(), &used);
  struct archive_entry* entry = archive_entry_new();
  archive_entry_set_filetype(entry, AE_IFREG);
  archive_write_header(writer, entry);
  archive_write_data(writer, plain.data(), plain.size());
  archive_entry_free(entry);
  archive_write_close(writer);
  archive_write_free(writer);
  bytes.resize(used);
  return bytes;
}

inline std::string chunk(const std::string& records, const std::string& by = "none") {
  return record(5, {{"compression", by}, {"size", u32(static_cast<std::uint32_t>(records.size()))}},
                packed(records, by));
}

}  // namespace swiftlet::interfaces::bag_bytes
