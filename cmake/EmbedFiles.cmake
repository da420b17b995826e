# cmake -DOUTPUT=assets.cpp -DFILES=a.html,b.css -P EmbedFiles.cmake
#   Writes the files as bytes into a source that defines swiftlet::web::assets().
set(types_html "text/html; charset=utf-8")
set(types_css "text/css; charset=utf-8")
set(types_js "text/javascript; charset=utf-8")
set(types_svg "image/svg+xml")
set(types_json "application/json")

string(REPLACE "," ";" FILES "${FILES}")
set(data "")
set(table "")
set(index 0)
foreach(file ${FILES})
  get_filename_component(name "${file}" NAME)
  get_filename_component(extension "${file}" LAST_EXT)
  string(SUBSTRING "${extension}" 1 -1 extension)
  if(NOT DEFINED types_${extension})
    message(FATAL_ERROR "${file}: no media type for .${extension}; add it to EmbedFiles.cmake")
  endif()
  file(READ "${file}" hex HEX)
  file(SIZE "${file}" size)
  file(SHA256 "${file}" hash)
  string(SUBSTRING "${hash}" 0 16 hash)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  string(APPEND data "constexpr unsigned char kData${index}[] = {${bytes}0};\n")
  string(APPEND table "      {\"${name}\", {reinterpret_cast<const char*>(kData${index}), ${size}},\n"
                      "       \"${types_${extension}}\", \"\\\"${hash}\\\"\"},\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE "${OUTPUT}" "#include \"web/server/assets.hpp\"\n\nnamespace swiftlet::web {\nnamespace {\n${data}}  // namespace\n
std::span<const Asset> assets() {\n  static const Asset kAssets[] = {\n${table}  };\n  return kAssets;\n}\n
}  // namespace swiftlet::web\n")
