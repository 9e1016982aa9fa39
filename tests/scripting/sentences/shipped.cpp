#include "shipped.h"

#include <atomic>
#include <cstdlib>
#include <map>
#include <thread>

namespace shipped {

using namespace stampede;

std::shared_ptr<const Library> library() {
  static const std::shared_ptr<const Library> all = Library::load({{STAMPEDE_SOURCE_DIR}});
  return all;
}

namespace {

std::vector<Meaning> meanings_of(const std::string& task) {
  const std::vector<OwnSentences> all = sentences_of(library(), task);
  std::vector<Meaning> made = {meaning_of(library(), task, all.front().variation, 0, all)};
  if (all.size() > 1) made.push_back(meaning_of(library(), task, all.back().variation, 0, all));
  if (std::getenv("STAMPEDE_ALL_VARIATIONS") != nullptr)
    for (std::size_t i = 1; i + 1 < all.size(); ++i)
      made.push_back(meaning_of(library(), task, all[i].variation, 0, all));
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

const Meaning& meaning(const std::string& task) {
  static std::map<std::string, Meaning> kept;
  const auto found = kept.find(task);
  if (found != kept.end()) return found->second;
  const std::vector<OwnSentences> all = sentences_of(library(), task);
  return kept.emplace(task, meaning_of(library(), task, all.front().variation, 0, all)).first->second;
}

}  // namespace shipped
