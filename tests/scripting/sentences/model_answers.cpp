#include "model_answers.h"

#include <nlohmann/json.hpp>
#include <sstream>

namespace stub {

using namespace stampede;

bool asks_back(const std::string& body) { return body.find("which goal does it mean") != std::string::npos; }

std::string right_answer(const std::string& body, const Meaning& meaning) {
  const std::string text = nlohmann::json::parse(body)["messages"].back()["content"];
  nlohmann::json answer = {{"things", nlohmann::json::array()}, {"goal", 0}};
  std::istringstream lines(text);
  bool goals = false;
  for (std::string line; std::getline(lines, line);) {
    goals |= line == "Goals:";
    const std::size_t dot = line.find(". ");
    if (dot == std::string::npos || dot > 2) continue;
    const int number = std::stoi(line);
    const std::string name = line.substr(dot + 2);
    if (goals && name == meaning.own.front()) answer["goal"] = number;
    for (const SpokenThing& thing : meaning.things)
      if (!goals && thing.phrase == name && thing.roles.wanted && !thing.region) answer["things"].push_back(number);
  }
  return answer.dump();
}

}  // namespace stub
