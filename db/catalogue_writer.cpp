#include "db/catalogue_writer.h"

#include <exception>
#include <thread>

#include "db/episode_writer.h"

namespace stampede {
struct CatalogueWriter::Impl {
  Impl(const std::filesystem::path& path, CatalogueWriterOptions chosen)
      : options(std::move(chosen)), catalogue(Catalogue::write(path)), queue(options.queue_bytes) {
    queue.know(catalogue.keys_after(last_seen));
  }

  void write_all();

  CatalogueWriterOptions options;
  Catalogue catalogue;         // of the writing thread once that runs
  std::int64_t last_seen = 0;  // greatest id whose key is known
  EpisodeQueue queue;
  std::exception_ptr failure;  // of the writing thread, until that has ended
  std::thread thread;
};

void CatalogueWriter::Impl::write_all() {
  try {
    while (const auto next = queue.next()) {
      const std::optional<std::int64_t> id = catalogue.add_if_new(next->episode, options.engine);
      if (id && options.committed) options.committed(*id, next->episode);
      queue.know(catalogue.keys_after(last_seen));
    }
  } catch (...) {
    failure = std::current_exception();
    queue.fail(failure);
  }
}

CatalogueWriter::CatalogueWriter(const std::filesystem::path& path, CatalogueWriterOptions options)
    : impl_(std::make_unique<Impl>(path, std::move(options))) {
  impl_->thread = std::thread([this] { impl_->write_all(); });
}

CatalogueWriter::~CatalogueWriter() {
  try {
    finish();
  } catch (...) {  // a destructor cannot say; finish() does
  }
}

bool CatalogueWriter::has(std::string_view key) const { return impl_->queue.has(key); }

void CatalogueWriter::finished(std::int64_t place, EpisodeRecord episode) {
  if (episode.reason != Reason::interrupted) check_record(episode);  // here, where the fault is, not in its thread
  impl_->queue.finished(place, std::move(episode));
}

void CatalogueWriter::abandon(std::int64_t place) { impl_->queue.abandon(place); }

void CatalogueWriter::finish() {
  if (!impl_->thread.joinable()) return;
  impl_->queue.end();
  impl_->thread.join();
  const std::exception_ptr failure = impl_->failure;
  try {
    impl_->catalogue.close();
  } catch (...) {
    if (!failure) throw;
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace stampede
