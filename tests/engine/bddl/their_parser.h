// A model of the parsers of LIBERO and BEHAVIOR, with what they lose: nested lists of small letters, sections taken
// from the end, the last line of a type, the init and language that stand first, the first form of each goal.
#pragma once

#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

struct TheirTree {
  bool list = false;
  std::string word;
  std::vector<TheirTree> items;
  std::string text() const {
    if (!list) return word;
    std::string all;
    for (const TheirTree& item : items) all += (all.empty() ? "" : " ") + item.text();
    return "(" + all + ")";
  }
};

struct TheirProblem {
  std::string name, language;
  std::map<std::string, std::vector<std::string>> objects, fixtures;
  std::map<std::string, TheirTree> regions;
  std::vector<std::string> interest, init, goal;
};

inline TheirTree their_tokens(const std::string& text) {
  std::vector<TheirTree> open(1);
  bool comment = false, in_word = false;
  for (const char raw : text) {
    const char c = static_cast<char>(std::tolower(static_cast<unsigned char>(raw)));
    if (c == '\n') comment = false;
    if (c == ';') comment = true;
    const bool blank = comment || std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!blank && c != '(' && c != ')') {
      if (!in_word) open.back().items.push_back({});
      open.back().items.back().word += c;
      in_word = true;
      continue;
    }
    in_word = false;
    if (!blank && c == '(') {
      open.push_back({true, "", {}});
    } else if (!blank) {
      if (open.size() == 1) throw std::runtime_error("Missing open parenthesis");
      TheirTree done = open.back();
      open.pop_back();
      open.back().items.push_back(done);
    }
  }
  if (open.size() != 1) throw std::runtime_error("Missing close parenthesis");
  if (open[0].items.size() != 1) throw std::runtime_error("Malformed expression");
  return open[0].items[0];
}

inline void their_groups(const TheirTree& group, std::map<std::string, std::vector<std::string>>& groups) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < group.items.size(); ++i) {
    if (group.items[i].word == "-") {
      groups[group.items.at(++i).word] = names;  // overwrites
      names.clear();
    } else {
      names.push_back(group.items[i].word);
    }
  }
}

inline TheirProblem their_problem(const std::string& text) {
  TheirProblem problem;
  const TheirTree top = their_tokens(text);
  for (std::size_t k = top.items.size() - 1; k >= 1; --k) {
    const TheirTree& group = top.items[k];
    const std::string head = group.items.at(0).word;
    const auto texts = [&] {
      std::vector<std::string> all;
      for (std::size_t i = 1; i < group.items.size(); ++i) all.push_back(group.items[i].text());
      return all;
    };
    if (head == "problem") problem.name = group.items.back().word;
    if (head == ":objects") their_groups(group, problem.objects);
    if (head == ":fixtures") their_groups(group, problem.fixtures);
    if (head == ":init") problem.init = texts();
    if (head == ":obj_of_interest") {
      for (const std::string& name : texts()) problem.interest.push_back(name);
    }
    if (head == ":language") {
      problem.language.clear();
      for (const std::string& word : texts()) problem.language += (problem.language.empty() ? "" : " ") + word;
    }
    if (head == ":regions") {
      for (std::size_t i = 1; i < group.items.size(); ++i) {
        std::string target;
        for (const TheirTree& attribute : group.items[i].items) {
          if (attribute.list && attribute.items.at(0).word == ":target") target = attribute.items.at(1).word;
        }
        problem.regions[target + "_" + group.items[i].items.at(0).word] = group.items[i];
      }
    }
    if (head == ":goal") {
      const TheirTree& form = group.items.at(1);
      if (form.items.at(0).word != "and") problem.goal.push_back(form.text());
      for (std::size_t i = 1; form.items.at(0).word == "and" && i < form.items.size(); ++i) {
        problem.goal.push_back(form.items[i].text());
      }
    }
  }
  return problem;
}
