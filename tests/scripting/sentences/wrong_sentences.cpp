#include "wrong_sentences.h"

#include <algorithm>
#include <array>
#include <set>

#include "engine/language/reading.h"

namespace wrong {

using namespace stampede;

namespace {

std::string joined(const std::vector<Word>& words) {
  std::string text;
  for (const Word& word : words) {
    if (word.text == "'s") {
      text += "'s";
      continue;
    }
    if (!text.empty() && word.before != ' ') text += word.before;
    text += (text.empty() ? "" : " ") + (word.text == "outof" ? "out of" : word.text);
  }
  return text;
}

class Maker {
 public:
  Maker(const Meaning& meaning, const std::string& from, std::vector<Sentence>& made)
      : meaning_(meaning), from_(from), made_(made), reading_(read_sentence(from, meaning)) {}

  void make() {
    for (std::size_t i = 0; i < reading_.words.size(); ++i) {
      const Word& word = reading_.words[i];
      if (word.kind == WordKind::colour)
        replace("colour", i, {"red", "blue", "green", "yellow", "purple", "white", "orange"});
      if (word.kind == WordKind::number) replace("count", i, {"one", "two", "three", "four", "five"});
      if (word.kind == WordKind::place) replace("side", i, {"left", "right", "top", "bottom", "middle", "rear"});
      if (word.kind == WordKind::noun) replace_noun(i);
    }
    negate();
    swap_segments();
    swap_mentions();
  }

 private:
  void add(const std::string& rule, const std::vector<Word>& words) {
    const std::string text = joined(words);
    if (text != joined(reading_.words)) made_.push_back({rule, text, from_});
  }

  std::string sense(const std::string& text, std::size_t at) const {
    std::vector<Word> words = reading_.words;
    words[at].text = text;
    return read_sentence(joined(words), meaning_).words.size() > at
               ? read_sentence(joined(words), meaning_).words[at].sense
               : "";
  }

  void replace(const std::string& rule, std::size_t at, const std::vector<std::string>& by) {
    for (const std::string& one : by) {
      if (sense(one, at) == reading_.words[at].sense) continue;
      std::vector<Word> words = reading_.words;
      words[at].text = one;
      add(rule, words);
    }
  }

  // By another thing of the scene, and by one that no scene has.
  void replace_noun(std::size_t at) {
    const Word& noun = reading_.words[at];
    const Mention* mention = nullptr;
    for (const Mention& one : reading_.mentions)
      if (one.head == at) mention = &one;
    if (mention == nullptr || mention->things.empty() || mention->aside) return;
    std::set<std::string> by = {"hammer", "banana"};
    for (const SpokenThing& thing : meaning_.things) {
      if (std::find(mention->things.begin(), mention->things.end(), thing.name) != mention->things.end()) continue;
      // A place without a body, or a part of what is named anyway, may be what is meant.
      const std::string body = thing.name.substr(0, thing.name.find('.'));
      const bool named = body != thing.name &&
                         std::any_of(reading_.mentions.begin(), reading_.mentions.end(), [&](const Mention& one) {
                           return std::any_of(one.things.begin(), one.things.end(), [&](const std::string& name) {
                             return name == body || name.starts_with(body + ".");
                           });
                         });
      if (thing.region || named) continue;
      const bool belongs = std::any_of(mention->things.begin(), mention->things.end(), [&](const std::string& name) {
        return name.starts_with(thing.name + ".") || thing.name.starts_with(name + ".");
      });
      if (belongs || handled_alike(mention->things, thing.name) || done_so(*mention, thing))
        continue;  // the sentence may stay right
      for (const std::string& head : thing.heads)
        if (head != noun.sense && !is_called(mention->things, head) && !said_of(mention->colours, head) &&
            meaning_.lexicon.read("the " + head).back().kind == WordKind::noun)
          by.insert(head);
    }
    for (const std::string& one : by) {
      std::vector<Word> words = reading_.words;
      words[at].text = one + (noun.plural ? "s" : "");
      add("thing", words);
    }
  }

  bool is_called(const std::vector<std::string>& names, const std::string& word) const {
    return std::any_of(meaning_.things.begin(), meaning_.things.end(), [&](const SpokenThing& thing) {
      return thing.words.contains(word) && std::find(names.begin(), names.end(), thing.name) != names.end();
    });
  }

  // The author calls the other thing by that colour too: where the table is azure.
  bool said_of(const std::vector<std::string>& colours, const std::string& noun) const {
    for (const std::string& sentence : meaning_.own)
      for (const Mention& mention : read_sentence(sentence, meaning_).mentions)
        for (const std::string& colour : mention.colours)
          if (mention.sense == noun && std::find(colours.begin(), colours.end(), colour) != colours.end()) return true;
    return false;
  }

  // The other thing is handled by such a step too.
  bool done_so(const Mention& mention, const SpokenThing& other) const {
    const auto verb = reading_.segments[mention.segment].verb;
    if (!verb || mention.part != "object") return false;
    const std::set<std::string>& skills = meaning_.lexicon.skills_of(reading_.words[*verb].sense);
    return std::any_of(meaning_.steps.begin(), meaning_.steps.end(), [&](const ToldStep& step) {
      return skills.contains(step.skill) && !step.arguments.empty() && step.arguments.front() == other.name;
    });
  }

  // Both are what steps of one skill are about: another one of the things to be done.
  bool handled_alike(const std::vector<std::string>& names, const std::string& other) const {
    const auto skills_of = [&](const std::string& name) {
      std::set<std::string> skills;
      for (const ToldStep& step : meaning_.steps)
        if (!step.arguments.empty() &&
            (step.arguments.front() == name || step.arguments.front().starts_with(name + ".")))
          skills.insert(step.skill);
      return skills;
    };
    const std::set<std::string> theirs = skills_of(other);
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      const std::set<std::string> ours = skills_of(name);
      return std::any_of(ours.begin(), ours.end(), [&](const std::string& skill) { return theirs.contains(skill); });
    });
  }

  void negate() {
    for (const char* start : {"do not", "never", "don't"}) {
      std::vector<Word> words = reading_.words;
      const std::size_t colon = from_.find(": ");
      std::size_t at = 0;
      if (colon != std::string::npos)
        for (std::size_t i = 0; i < words.size(); ++i)
          if (words[i].before == ':') at = i;
      if (words[at].kind != WordKind::verb) continue;
      Word no{start, start, WordKind::negation, false, false, words[at].before};
      words[at].before = ' ';
      words.insert(words.begin() + static_cast<std::ptrdiff_t>(at), no);
      add("negation", words);
    }
  }

  // `a, then b`: b, then a, where both say what to do.
  void swap_segments() {
    for (std::size_t i = 0; i + 1 < reading_.segments.size(); ++i) {
      const Segment &a = reading_.segments[i], &b = reading_.segments[i + 1];
      const std::string intro = b.intro ? reading_.words[*b.intro].text : "";
      const bool both = a.verb && b.verb && (intro == "and" || intro == "then" || intro.empty());
      if (!both || reading_.words[b.begin].before == ':' || (i > 0 && reading_.words[a.begin].before != ':')) continue;
      if (i + 2 < reading_.segments.size() || *a.verb != a.begin) continue;
      std::vector<Word> words(reading_.words.begin(), reading_.words.begin() + static_cast<std::ptrdiff_t>(a.begin));
      const std::size_t skip = b.intro ? 1 : 0;
      for (std::size_t k = b.begin + skip; k < b.end; ++k) words.push_back(reading_.words[k]);
      words[a.begin].before = reading_.words[a.begin].before;
      words.push_back({"and", "and", WordKind::grammar, false, false, ' '});
      words.push_back({"then", "then", WordKind::order, false, false, ' '});
      for (std::size_t k = a.begin; k < a.end; ++k) words.push_back(reading_.words[k]);
      words[words.size() - (a.end - a.begin)].before = ' ';
      add("order", words);
    }
    if (!meaning_.ordered) return;
    std::vector<std::size_t> colours;
    for (std::size_t i = 0; i < reading_.words.size(); ++i)
      if (reading_.words[i].kind == WordKind::colour) colours.push_back(i);
    for (std::size_t i = 0; i + 1 < colours.size(); ++i) {
      std::vector<Word> words = reading_.words;
      std::swap(words[colours[i]].text, words[colours[i + 1]].text);
      add("order", words);
    }
  }

  // `put the cube into the drawer`: put the drawer into the cube.
  void swap_mentions() {
    static const std::set<std::string> kInto = {"in", "into", "on", "onto", "over", "from", "off", "outof", "out"};
    for (std::size_t i = 0; i + 1 < reading_.mentions.size(); ++i) {
      const Mention &a = reading_.mentions[i], &b = reading_.mentions[i + 1];
      if (a.segment != b.segment || !kInto.contains(before(b)) || a.things.empty() || b.things.empty()) continue;
      if (!reading_.segments[a.segment].verb || a.sense == b.sense || a.after) continue;
      std::vector<Word> words = reading_.words;
      std::swap(words[a.head], words[b.head]);
      add("roles", words);
    }
  }

  std::string before(const Mention& mention) const { return mention.after ? reading_.words[*mention.after].text : ""; }

  const Meaning& meaning_;
  const std::string& from_;
  std::vector<Sentence>& made_;
  Reading reading_;
};

}  // namespace

std::vector<Sentence> sentences_from(const Meaning& meaning) {
  std::vector<Sentence> made;
  for (const std::string& sentence : meaning.own) Maker(meaning, sentence, made).make();
  return made;
}

}  // namespace wrong
