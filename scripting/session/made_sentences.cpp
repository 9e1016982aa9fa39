#include "scripting/session/made_sentences.h"

#include "engine/record/record.h"
#include "engine/start/language.h"

namespace stampede {
namespace {

LanguageRecord row_of(const MadeSentence& sentence, std::string text, int segment = -1) {
  return {.level = sentence.level,
          .text = std::move(text),
          .segment = segment,
          .source = LanguageSource::model,
          .grain = sentence.grain,
          .model = sentence.model};
}

bool is_of(const MadeSentence& one, const std::string& variation) {
  if (one.level == LanguageLevel::task) return one.of == variation;
  if (one.level == LanguageLevel::subgoal) return one.of == subgoal_key(one.of.substr(0, one.of.find(' ')), variation);
  return true;
}

}  // namespace

std::shared_ptr<const std::vector<MadeSentence>> sentences_for(const std::vector<MadeSentence>& all,
                                                               const std::string& variation) {
  auto ours = std::make_shared<std::vector<MadeSentence>>();
  for (const MadeSentence& one : all)
    if (is_of(one, variation)) ours->push_back(one);
  return ours;
}

void add_sentences(const std::vector<MadeSentence>& sentences, const Library& library, EpisodeRecord& record) {
  if (record.scene.document.empty()) return;
  const Scene scene = scene_from_document(record.scene.document);
  const Domain& domain = library.domain_of(record.task);
  for (const MadeSentence& one : sentences) {
    if (one.level == LanguageLevel::task) record.labels.language.push_back(row_of(one, one.text));
    if (one.level == LanguageLevel::world) {
      const Predicate* predicate = domain.predicate(one.of);
      for (const FactRecord& fact : record.labels.facts)
        if (predicate != nullptr && fact.fact.predicate == one.of && fact.start_step == 0)
          record.labels.language.push_back(
              row_of(one, fill(one.text, predicate->parameters, fact.fact.arguments, scene)));
    }
    const SkillInfo* skill = one.level == LanguageLevel::skill ? library.skill(one.of) : nullptr;
    for (const SegmentRecord& segment : record.labels.segments) {
      if (one.level == LanguageLevel::subgoal && segment.kind == SegmentKind::subgoal &&
          one.of == subgoal_key(segment.skill, record.variation))
        record.labels.language.push_back(row_of(one, one.text, segment.ordinal));
      if (segment.skill != one.of) continue;
      if (skill != nullptr && segment.kind == SegmentKind::skill)
        record.labels.language.push_back(
            row_of(one, fill(one.text, skill->parameters, segment.arguments, scene), segment.ordinal));
      if (one.level == LanguageLevel::motion && segment.kind == SegmentKind::motion)
        record.labels.language.push_back(row_of(one, one.text, segment.ordinal));
    }
  }
}

}  // namespace stampede
