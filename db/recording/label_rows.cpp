#include "db/recording/label_rows.h"

#include <cmath>

#include "db/recording/csv_file.h"
#include "db/recording/json_value.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"
#include "engine/base/text_file.h"

namespace stampede {
namespace {

std::int64_t whole(double number, const std::string& place, const std::string& what) {
  if (number == std::floor(number) && std::abs(number) < 1e12) return static_cast<std::int64_t>(number);
  throw Error(place, what + " is no whole number", "write it as 12");
}

class JsonLabels {
 public:
  JsonLabels(const Value& root, const LabelClock& clock) : clock_(clock) {
    require_fields(root, {"labelled_by", "model", "clock", "segments", "facts", "language"});
    labelled_by_ = root.text_or("labelled_by", "person");
    model_ = root.text_or("model", "");
    if (const Value& named = root["clock"]; named.present()) {
      if (clock.recording == nullptr)
        throw Error(named.place, "clocks are those of a recording, and its labels lie in its folder",
                    "give times in seconds from frame 0");
      its_clock_ = &clock.recording->clock(named);
    }
    for (const Value& value : list_in(root, "segments")) segment(value);
    for (const Value& value : list_in(root, "facts")) fact(value);
    for (const Value& value : list_in(root, "language")) sentence(value);
  }
  std::vector<LabelRow> rows;

 private:
  LabelRow& row(const Value& value) {
    LabelRow& one = rows.emplace_back();
    one.place = value.place;
    one.labelled_by = value.text_or("labelled_by", labelled_by_);
    one.model = value.text_or("model", model_);
    const auto time = [&](const char* field) -> std::optional<double> {
      if (!value[field].present()) return std::nullopt;
      const double number = value[field].as_number();
      return its_clock_ == nullptr ? number : its_clock_->time(number) - clock_.frames.begin;
    };
    const auto frame = [&](const char* field) -> std::optional<std::int64_t> {
      if (!value[field].present()) return std::nullopt;
      return whole(value[field].as_number(), value[field].place, field);
    };
    one.span = {time("start_s"), time("end_s"), frame("first_frame"), frame("end_frame")};
    return one;
  }
  void segment(const Value& value) {
    require_fields(value, {"kind", "name", "arguments", "start_s", "end_s", "first_frame", "end_frame", "outcome",
                           "reason", "label", "labelled_by", "model"});
    LabelRow& one = row(value);
    one.kind = required(value, "kind", "subgoal, skill or motion").as_text();
    one.name = required(value, "name", "name the skill").as_text();
    if (value["arguments"].present()) one.arguments = texts_in(value["arguments"]);
    one.outcome = value.text_or("outcome", "success");
    one.reason = value.text_or("reason", "");
    one.text = value.text_or("label", "");
  }
  void fact(const Value& value) {
    require_fields(value, {"fact", "start_s", "end_s", "first_frame", "end_frame", "labelled_by", "model"});
    LabelRow& one = row(value);
    one.kind = "fact";
    one.arguments = texts_in(required(value, "fact", "write [\"on\", \"cup\", \"table\"]"));
    if (one.arguments.empty()) value["fact"].expected("a predicate and what it holds of");
    one.name = one.arguments.front();
    one.arguments.erase(one.arguments.begin());
  }
  void sentence(const Value& value) {
    require_fields(value, {"level", "text", "segment", "grain", "model", "labelled_by"});
    LabelRow& one = row(value);
    one.kind = "language";
    one.name = value.text_or("level", "task");
    one.text = required(value, "text", "write the sentence").as_text();
    one.grain = value.text_or("grain", "");
    if (value["segment"].present()) one.segment = whole(value["segment"].as_number(), value.place, "segment");
  }

  const LabelClock& clock_;
  const RecordingClock* its_clock_ = nullptr;
  std::string labelled_by_, model_;
};

std::vector<LabelRow> csv_rows(const std::filesystem::path& file, const std::string& shown) {
  CsvFile csv(file, shown);
  const std::vector<std::string> known = {"kind",        "name",      "arguments", "start_s", "end_s",
                                          "first_frame", "end_frame", "outcome",   "reason",  "text",
                                          "labelled_by", "model",     "grain"};
  for (const std::string& name : csv.header())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error(shown + ":1", "labels have no column '" + name + "'", did_you_mean(name, known));
  std::vector<LabelRow> rows;
  while (csv.next()) {
    LabelRow& row = rows.emplace_back();
    row.place = csv.place();
    for (std::size_t i = 0; i < csv.header().size(); ++i) {
      const std::string& column = csv.header()[i];
      const std::string text(csv.fields()[i]);
      if (text.empty()) continue;
      if (column == "kind") row.kind = text;
      if (column == "name") row.name = text;
      if (column == "arguments") row.arguments = split(text, ' ');
      if (column == "start_s") row.span.start_s = csv.number(i);
      if (column == "end_s") row.span.end_s = csv.number(i);
      if (column == "first_frame") row.span.first_frame = whole(csv.number(i), row.place, column);
      if (column == "end_frame") row.span.end_frame = whole(csv.number(i), row.place, column);
      if (column == "outcome") row.outcome = text;
      if (column == "reason") row.reason = text;
      if (column == "text") row.text = text;
      if (column == "labelled_by") row.labelled_by = text;
      if (column == "model") row.model = text;
      if (column == "grain") row.grain = text;
    }
  }
  return rows;
}

}  // namespace

std::vector<LabelRow> label_rows(const std::filesystem::path& file, const std::string& shown, const LabelClock& clock) {
  if (file.extension() == ".csv") return csv_rows(file, shown);
  if (file.extension() != ".json") throw Error(shown, "labels are a .json or a .csv file", "rename it");
  return JsonLabels(value_from_json(read_text_file(file), shown), clock).rows;
}

}  // namespace stampede
