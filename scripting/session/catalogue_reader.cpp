#include "stampede/catalogue_reader.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <thread>

#include "db/catalogue_set.h"
#include "engine/base/stopping.h"
#include "engine/record/arrays.h"
#include "engine/render/png.h"
#include "scripting/session/studio.h"

namespace stampede {
namespace {

// Calls work(0) … work(count - 1) in threads; throws what the first of them threw.
template <typename Work>
void each_in_threads(std::size_t count, int threads, const Work& work) {
  std::vector<std::exception_ptr> failures(count);
  const auto stride = static_cast<std::size_t>(std::max(1, threads));
  const auto every = [&](std::size_t first) {
    for (std::size_t i = first; i < count; i += stride) {
      try {
        work(i);
      } catch (const std::exception&) {
        failures[i] = std::current_exception();
      }
    }
  };
  std::vector<std::jthread> helpers;
  for (std::size_t first = 1; first < std::min(stride, count); ++first) helpers.emplace_back(every, first);
  every(0);
  helpers.clear();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

Picture picture_of(CameraPicture drawn) {
  return {drawn.width,
          drawn.height,
          std::move(drawn.rgb),
          std::move(drawn.depth),
          std::move(drawn.instance),
          std::move(drawn.semantic)};
}

template <typename Value>
PictureFrames joined(const std::vector<Picture>& pictures, std::vector<Value> Picture::*values, int channels) {
  PictureFrames frames;
  const Picture& first = pictures.front();
  frames.shape = {static_cast<std::int64_t>(pictures.size()), first.height, first.width};
  if (channels > 1) frames.shape.push_back(channels);
  std::vector<Value> all;
  all.reserve(pictures.size() * (first.*values).size());
  for (const Picture& picture : pictures) all.insert(all.end(), (picture.*values).begin(), (picture.*values).end());
  frames.data = std::move(all);
  return frames;
}

PictureFrames joined(const std::vector<Picture>& pictures, PictureKind kind) {
  switch (kind) {
    case PictureKind::rgb:
      return joined(pictures, &Picture::rgb, 3);
    case PictureKind::depth:
      return joined(pictures, &Picture::depth, 1);
    case PictureKind::instance:
      return joined(pictures, &Picture::instance, 1);
    case PictureKind::semantic:
      break;
  }
  return joined(pictures, &Picture::semantic, 1);
}

}  // namespace

std::vector<ReadyQuestion> ready_questions() {
  std::vector<ReadyQuestion> all;
  for (const NamedQuery& one : named_queries()) all.push_back({one.name, one.description, one.sql});
  return all;
}

struct CatalogueReader::Impl {
  CatalogueSet catalogues;
  std::optional<Studio> studio = {};  // from the first picture on that is drawn
  // Of the last picture or state: the next one is mostly of the same episode.
  std::int64_t record_id = -1;
  std::shared_ptr<const EpisodeRecord> record = {};

  Studio& drawing() { return studio ? *studio : studio.emplace(); }

  const std::shared_ptr<const EpisodeRecord>& record_of(std::int64_t episode) {
    if (record_id != episode) {
      const auto [catalogue, number] = catalogues.place(episode);
      record = std::make_shared<const EpisodeRecord>(catalogue.read_episode(number));
      record_id = episode;
    }
    return record;
  }

  [[noreturn]] void not_stored(std::int64_t episode, const std::string& column, std::int64_t frame) const {
    const std::string where = "episode " + std::to_string(episode);
    // Throws for a name that there is not, with the nearest one.
    const auto [catalogue, number] = catalogues.place(episode);
    if (catalogue.read_arrays(number, {{column}}).pictures.empty())
      throw Error(where, "'" + column + "' is no picture");
    throw Error(where, "frame " + std::to_string(frame) + " has no stored picture '" + column + "'",
                "draw it now, or store it: `stampede render FILE --into`");
  }
};

CatalogueReader::CatalogueReader(const std::filesystem::path& file)
    : CatalogueReader(std::vector<std::filesystem::path>{file}) {}
CatalogueReader::CatalogueReader(const std::vector<std::filesystem::path>& files)
    : impl_(std::unique_ptr<Impl>(new Impl{CatalogueSet(files)})) {}
CatalogueReader::~CatalogueReader() = default;
CatalogueReader::CatalogueReader(CatalogueReader&&) noexcept = default;
CatalogueReader& CatalogueReader::operator=(CatalogueReader&&) noexcept = default;

Rows CatalogueReader::query(std::string_view question, const std::vector<SqlValue>& parameters,
                            std::int64_t most_rows) const {
  return impl_->catalogues.query(question, {parameters, most_rows});
}

EpisodeArrays CatalogueReader::arrays(std::int64_t episode, const ArrayRequest& request) const {
  const auto [catalogue, number] = impl_->catalogues.place(episode);
  return catalogue.read_arrays(number, request);
}

PictureFrames CatalogueReader::pictures(std::int64_t episode, const std::string& column,
                                        const PictureFramesRequest& request) const {
  if (request.frames.empty()) throw Error("PictureFramesRequest::frames", "no frame is named");
  if (request.threads < 1) throw Error("PictureFramesRequest::threads", "it is at least 1");
  const std::optional<PictureColumn> wanted = picture_column(column);
  if (!wanted) impl_->not_stored(episode, column, request.frames.front());
  const auto [catalogue, number] = impl_->catalogues.place(episode);
  const std::vector<std::string> files =
      catalogue.read_images(number, request.frames, wanted->camera, to_string(wanted->kind));
  for (std::size_t i = 0; i < files.size() && !request.draw; ++i)
    if (files[i].empty()) impl_->not_stored(episode, column, request.frames[i]);

  std::vector<Picture> pictures(files.size());
  const std::atomic<bool>* const stop = stop_of_this_thread();
  each_in_threads(files.size(), request.threads, [&](std::size_t i) {
    if (!files[i].empty() && !(stop && stop->load()))
      from_file({reinterpret_cast<const std::uint8_t*>(files[i].data()), files[i].size()}, wanted->kind, pictures[i]);
  });
  PictureRequest drawn{.camera = wanted->camera, .rgb = false};
  drawn.rgb = wanted->kind == PictureKind::rgb;
  drawn.depth = wanted->kind == PictureKind::depth;
  drawn.instance = wanted->kind == PictureKind::instance;
  drawn.semantic = wanted->kind == PictureKind::semantic;
  const auto stored = std::find_if(pictures.begin(), pictures.end(), [](const Picture& one) { return one.width > 0; });
  if (stored != pictures.end()) {
    drawn.width = stored->width;
    drawn.height = stored->height;
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    heed_stop();
    if (files[i].empty()) pictures[i] = picture_of(picture(episode, request.frames[i], drawn));
  }
  for (const Picture& one : pictures)
    if (one.width != pictures.front().width || one.height != pictures.front().height)
      throw Error("episode " + std::to_string(episode), "pictures '" + column + "' of these frames differ in size",
                  "ask for those of one size");
  return joined(pictures, wanted->kind);
}

CameraPicture CatalogueReader::picture(std::int64_t episode, std::int64_t frame, const PictureRequest& request) const {
  return impl_->drawing().picture(impl_->record_of(episode), frame, request);
}

CameraPoints CatalogueReader::points(std::int64_t episode, std::int64_t frame, const PictureRequest& request) const {
  return impl_->drawing().points(impl_->record_of(episode), frame, request);
}

WorldState CatalogueReader::state(std::int64_t episode, std::int64_t frame) const {
  return world_state(*impl_->record_of(episode), frame);
}

}  // namespace stampede
