#include "interfaces/files/relations.hpp"

#include "interfaces/files/line_fields.hpp"

namespace swiftlet::interfaces {
namespace {

const LineFormat& relationFormat() {
  static const LineFormat kFormat{"relation", {"t1", "t2", "x", "y", "z", "roll", "pitch", "yaw"}};
  return kFormat;
}

std::vector<common::Relation> read(LineReader reader) {
  std::vector<common::Relation> relations;
  std::vector<Word> words;
  while (nextWords(reader, words)) {
    const LineFields fields(reader, words, relationFormat());
    common::Relation relation;
    relation.from = fields.stamp(0);
    relation.to = fields.stamp(1);
    relation.T_from_to.position_m = {fields.coordinate_m(2), fields.coordinate_m(3), fields.coordinate_m(4)};
    const double roll = fields.number(5), pitch = fields.number(6), yaw = fields.number(7);
    relation.T_from_to.rotation = common::quaternionFrom({roll, pitch, yaw});
    relations.push_back(relation);
  }
  return relations;
}

}  // namespace

std::vector<common::Relation> readRelations(const std::filesystem::path& file) { return read(LineReader(file)); }

std::vector<common::Relation> parseRelations(std::string_view text, const std::string& name) {
  return read(LineReader::fromBytes(text, name));
}

}  // namespace swiftlet::interfaces
