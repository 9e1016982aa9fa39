#include "shipped.h"

#include <atomic>
#include <cstdlib>
#include <map>
#include <mutex>
#include <thread>

namespace shipped {

using namespace stampede;

std::shared_ptr<const Library> library() {
  static const std::shared_ptr<const Library> all = Library::load({{STAMPEDE_SOURCE_DIR}});
  return all;
}

namespace {

// Values by key, kept once made. Threads make those of different keys side by side.
template <typename Key, typename Made>
class Kept {
 public:
  template <typename Make>
  const Made& get(const Key& key, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = kept_.find(key); found != kept_.end()) return found->second;
    }
    Made made = make();
    const std::lock_guard lock(mutex_);
    return kept_.try_emplace(key, std::move(made)).first->second;
  }

 private:
  std::mutex mutex_;
  std::map<Key, Made> kept_;
};

const std::vector<OwnSentences>& sentences(const std::string& task) {
  static Kept<std::string, std::vector<OwnSentences>> kept;
  return kept.get(task, [&] { return sentences_of(library(), task); });
}

std::vector<Meaning> meanings_of(const std::string& task) {
  const std::vector<OwnSentences>& all = sentences(task);
  std::vector<Meaning> made = {meaning(task, all.front().variation)};
  if (all.size() > 1) made.push_back(meaning(task, all.back().variation));
  if (std::getenv("STAMPEDE_ALL_VARIATIONS") != nullptr)
    for (std::size_t i = 1; i + 1 < all.size(); ++i) made.push_back(meaning(task, all[i].variation));
  return made;
}

}  // namespace

const std::vector<Meaning>& meanings() {
  static const std::vector<Meaning> all = [] {
    std::vector<std::string> names;
    for (const ScriptFile* file : library()->files(DefinitionKind::task)) names.push_back(file->name);
    std::vector<std::vector<Meaning>> found(names.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t i = next++; i < names.size(); i = next++) found[i] = meanings_of(names[i]);
    };
    std::thread other(work);
    work();
    other.join();
    std::vector<Meaning> list;
    for (std::vector<Meaning>& some : found)
      for (Meaning& one : some) list.push_back(std::move(one));
    return list;
  }();
  return all;
}

const Meaning& meaning(const std::string& task, const std::string& variation) {
  static Kept<std::pair<std::string, std::string>, Meaning> kept;
  const std::vector<OwnSentences>& all = sentences(task);
  const std::string& named = variation.empty() ? all.front().variation : variation;
  return kept.get({task, named}, [&] { return meaning_of(library(), task, named, 0, all); });
}

}  // namespace shipped
