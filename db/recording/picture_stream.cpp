#include "db/recording/picture_stream.h"

#include <libdeflate.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>

#include "db/recording/csv_file.h"
#include "engine/base/file_scope.h"
#include "engine/base/hash.h"
#include "engine/base/read_file.h"
#include "engine/render/png.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr int kMostPixels = 4096;  // a side, as of cameras
constexpr std::uintmax_t kMostPictureBytes = std::uintmax_t{128} << 20;

std::uint32_t get32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

[[noreturn]] void truncated(const std::string& where) {
  throw Error(where, "this picture ends too early", "copy it again, or leave it out of the recording");
}

PictureHeader check_png(std::string_view bytes, StreamKind kind, const std::string& where) {
  constexpr std::size_t kSignature = 8, kHeader = 33, kBits = 24, kColour = 25;
  if (bytes.size() < kHeader) truncated(where);
  const int bits = bytes[kBits], colour = bytes[kColour];
  if (kind == StreamKind::rgb && (bits != 8 || colour != 2))
    throw Error(where, "a colour picture has 8 bits and 3 channels; this is another", "convert it to plain RGB");
  if (kind == StreamKind::depth && (bits != 16 || colour != 0))
    throw Error(where, "a depth picture has 16 bits and one channel; this is another", "write 16-bit grey");
  for (std::size_t at = kSignature; at + 12 <= bytes.size();) {
    const std::size_t length = get32(bytes, at);
    if (length > bytes.size() - at - 12) break;
    const std::string_view chunk = bytes.substr(at + 4, length + 4);
    if (libdeflate_crc32(0, chunk.data(), chunk.size()) != get32(bytes, at + 8 + length))
      throw Error(where, "this picture is damaged: a checksum does not agree", "copy it again");
    if (chunk.starts_with("IEND")) return {static_cast<int>(get32(bytes, 16)), static_cast<int>(get32(bytes, 20))};
    at += length + 12;
  }
  truncated(where);
}

// By its markers (ISO/IEC 10918-1, annex B) up to the scan, and by its end.
PictureHeader check_jpeg(std::string_view bytes, StreamKind kind, const std::string& where) {
  if (kind == StreamKind::depth) throw Error(where, "a depth picture cannot be JPEG, which loses depths", "write PNG");
  const std::size_t last = bytes.find_last_not_of('\0');
  if (last == std::string_view::npos || last < 3 || bytes.substr(last - 1, 2) != "\xff\xd9") truncated(where);
  PictureHeader header;
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (bytes[at] != '\xff') break;
    const auto marker = static_cast<std::uint8_t>(bytes[at + 1]);
    if (marker == 0xff) {
      ++at;
      continue;
    }
    const std::size_t length = get32(bytes, at) & 0xffff;
    if (length < 2 || length + 2 > bytes.size() - at) truncated(where);
    if (marker == 0xda && header.width > 0) return header;
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame && length >= 9) {
      if (bytes[at + 4] != 8 || bytes[at + 9] != 3)
        throw Error(where, "a colour picture has 8 bits and 3 channels; this is another", "convert it to plain RGB");
      header = {static_cast<int>(get32(bytes, at + 5) & 0xffff), static_cast<int>(get32(bytes, at + 3) & 0xffff)};
    }
    at += length + 2;
  }
  throw Error(where, "this is no JPEG picture that can be read", "write it anew");
}

std::string_view as_text(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

// A picture in its folder may be a link: it lies in the recording none the less, or it is refused.
void check_place(const FileScope& scope, const fs::path& path) {
  std::error_code ignored;
  if (fs::is_symlink(path, ignored) && !scope.contains(path))
    throw Error(path.string(), "this picture is a link to a file outside of the recording",
                "copy the file itself into the folder");
}

Bytes whole_file(const fs::path& path) {
  const std::string text = read_file(path, kMostPictureBytes);
  const auto* first = reinterpret_cast<const std::uint8_t*>(text.data());
  return {first, first + text.size()};
}

// Depths in our unit, within the range; the bytes as they are where nothing would change.
Bytes converted_depth(const Bytes& bytes, const RecordedStream& stream) {
  Picture picture;
  from_png(bytes, PictureKind::depth, picture);
  for (float& depth : picture.depth) {
    const double metres = std::round(depth / kDepthUnit) * stream.unit_m;
    depth = metres >= stream.near_m && metres <= stream.far_m ? static_cast<float>(metres) : 0;
  }
  return to_png(picture, PictureKind::depth);
}

double stamp_of(const fs::path& file, const std::string& shown) {
  const std::string name = file.stem().string();
  double stamp = 0;
  const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), stamp);
  if (error == std::errc() && stop == name.data() + name.size() && std::isfinite(stamp)) return stamp;
  throw Error(shown, "its name is no time in seconds",
              "name it 1695.033333.png, or give `times`: a CSV of time_s,file");
}

bool is_picture(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

void list_by_names(const RecordingFile& recording, const RecordedStream& stream, PictureStream& pictures) {
  std::vector<std::pair<double, fs::path>> found;
  const FileScope scope({recording.folder});
  for (const auto& entry : fs::directory_iterator(recording.path_of(stream.file, stream.place))) {
    if (!is_picture(entry.path())) continue;
    check_place(scope, entry.path());
    found.emplace_back(stamp_of(entry.path(), entry.path().string()), entry.path());
  }
  std::sort(found.begin(), found.end());
  for (const auto& [stamp, path] : found) {
    if (!pictures.time.empty() && !(stream.clock.time(stamp) > pictures.time.back()))
      throw Error(path.string(), "another picture has the same time", "leave one of them out");
    pictures.time.push_back(stream.clock.time(stamp));
    pictures.files.push_back(path);
    pictures.shown.push_back(path.string());
  }
}

void list_by_times(const RecordingFile& recording, const RecordedStream& stream, PictureStream& pictures) {
  const std::string shown = recording.shown_path(stream.times);
  CsvFile csv(recording.path_of(stream.times, stream.place), shown);
  if (csv.header() != std::vector<std::string>{"time_s", "file"})
    throw Error(shown + ":1", "the times of pictures have the columns time_s,file, and no other");
  const fs::path folder = recording.folder / stream.file;
  const FileScope scope({recording.folder});
  std::map<std::string, std::string> seen;  // the row that named a picture
  int repeated = 0;
  while (csv.next()) {
    const double stamp = csv.number(0);
    if (std::isnan(stamp)) throw Error(csv.place(), "this row has no time", "give each picture its stamp");
    const double time = stream.clock.time(stamp);
    if (!pictures.time.empty() && !(time > pictures.time.back()))
      throw Error(csv.place(), "its clock runs backwards", "sort the rows by time, and leave out those sent twice");
    const std::string name(csv.fields()[1]);
    std::error_code ignored;
    if (name.empty() || fs::path(name).filename() != name || !fs::is_regular_file(folder / name, ignored))
      throw Error(csv.place(), "there is no picture '" + name + "' in " + folder.string(),
                  "leave the row out: a frame without a picture is no fault");
    check_place(scope, folder / name);
    const auto [before, first] = seen.emplace(name, csv.place());
    if (!first && repeated++ == 0)
      pictures.note = csv.place() + ": the picture '" + name + "' was named before, at " + before->second;
    pictures.time.push_back(time);
    pictures.files.push_back(folder / name);
    pictures.shown.push_back((folder / name).string());
  }
  if (repeated > 1) pictures.note += "; so were " + std::to_string(repeated - 1) + " more";
}

// Pictures of one stream, read by several threads at once, each of another.
struct PictureReader {
  PictureReader(const RecordedStream& its_stream, const PictureStream& all, const Camera& its_camera)
      : stream(its_stream), pictures(all), camera(its_camera) {}

  Bytes read(std::size_t at) {
    const std::string& where = pictures.shown[chosen[at]];
    Bytes bytes = whole_file(pictures.files[chosen[at]]);
    const PictureHeader header = check_picture(as_text(bytes), stream.kind, where);
    if (header.width != camera.width || header.height != camera.height)
      throw Error(where,
                  "this picture has " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                      " pixels, and camera " + camera.name + " was measured at " + std::to_string(camera.width) +
                      " x " + std::to_string(camera.height),
                  "calibrate at the size of the pictures, or scale the camera file to it");
    hashes[at] = content_hash(as_text(bytes));
    return stream.kind == StreamKind::depth ? converted_depth(bytes, stream) : bytes;
  }

  const RecordedStream stream;
  const PictureStream pictures;
  const Camera camera;
  std::vector<std::size_t> chosen;  // which of the stream's, in the order of the store
  std::vector<std::string> hashes;  // of the recorded bytes, likewise
};

}  // namespace

PictureStream read_picture_stream(const RecordingFile& recording, const RecordedStream& stream) {
  PictureStream pictures;
  stream.times.empty() ? list_by_names(recording, stream, pictures) : list_by_times(recording, stream, pictures);
  if (pictures.files.empty())
    throw Error(stream.place, "there is no picture in " + recording.shown_path(stream.file), "leave the stream out");
  return pictures;
}

std::array<int, 2> first_size(const RecordingFile& recording, const RecordedStream& stream) {
  const PictureStream pictures = read_picture_stream(recording, stream);
  const PictureHeader header = check_picture(as_text(whole_file(pictures.files[0])), stream.kind, pictures.shown[0]);
  return {header.width, header.height};
}

PictureHeader check_picture(std::string_view bytes, StreamKind kind, const std::string& where) {
  const bool png = bytes.starts_with("\x89PNG\r\n\x1a\n");
  if (png || bytes.starts_with("\xff\xd8\xff")) {
    const PictureHeader header = png ? check_png(bytes, kind, where) : check_jpeg(bytes, kind, where);
    const auto fits = [](int side) { return side >= 1 && side <= kMostPixels; };
    if (fits(header.width) && fits(header.height)) return header;
    throw Error(where,
                "this picture says that it has " + std::to_string(static_cast<std::uint32_t>(header.width)) + " x " +
                    std::to_string(static_cast<std::uint32_t>(header.height)) + " pixels, at most 4096 a side",
                "scale the pictures down, and calibrate at that size");
  }
  throw Error(where, bytes.empty() ? "this picture is empty" : "this is neither a PNG nor a JPEG picture",
              "write PNG (8 bits a channel, depth 16), or JPEG for colours");
}

std::function<std::string()> add_pictures(const RecordedStream& stream, const PictureStream& pictures,
                                          const std::vector<std::int64_t>& chosen, const Camera& camera,
                                          int camera_index, ImageStore& images) {
  auto reader = std::make_shared<PictureReader>(stream, pictures, camera);
  for (std::size_t frame = 0; frame < chosen.size(); ++frame) {
    if (chosen[frame] < 0) continue;
    const std::size_t at = reader->chosen.size();
    reader->chosen.push_back(static_cast<std::size_t>(chosen[frame]));
    images.append_made({static_cast<std::int64_t>(frame), camera_index, std::string(to_string(stream.kind)),
                        camera.width, camera.height},
                       [reader, at] { return reader->read(at); });
  }
  reader->hashes.resize(reader->chosen.size());
  return [reader] {
    Hasher hasher;
    for (const std::string& hash : reader->hashes) hasher.text(hash);
    return hasher.digest();
  };
}

}  // namespace stampede
