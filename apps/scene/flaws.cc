#include "apps/scene/flaws.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include "apps/scene/values.h"

namespace platen::apps {
namespace {

using Form = dem::Flaw::Form;

struct FormRule {
  const char *word;
  Form form;
  const char *size; // the clause that says how large it is; "": it is endless
};
constexpr FormRule forms[] = {
    {"plane", Form::plane, ""}, {"disc", Form::disc, "radius"}, {"rectangle", Form::rectangle, "widths"}};
const std::vector<std::string> clause_words{"at", "normal", "radius", "widths", "strength", "cut"};

// What stands after each word, up to the next one.
std::map<std::string, std::string> clauses_of(std::istringstream &words) {
  std::map<std::string, std::string> clauses;
  std::string *last = nullptr;
  for (std::string word; words >> word;) {
    const bool begins = std::count(clause_words.begin(), clause_words.end(), word) > 0;
    if (begins && clauses.count(word) > 0) throw ValueError("says \"" + word + "\" twice");
    if (!begins && last == nullptr)
      throw ValueError("has \"" + word + "\" after its form." + did_you_mean(word, clause_words));
    if (begins)
      last = &clauses[word];
    else
      *last += (last->empty() ? "" : " ") + word;
  }
  return clauses;
}

std::vector<double> numbers_of(const std::string &word, const std::string &text, std::size_t count,
                               const std::string &unit, const Range &range) {
  std::vector<double> numbers;
  try {
    numbers = read_list(text, Quantity(word, unit, range));
  } catch (const ValueError &error) {
    throw ValueError("after \"" + word + "\" " + error.what());
  }
  if (numbers.size() != count)
    throw ValueError("needs " + std::to_string(count) + (count == 1 ? " number" : " numbers") + " after \"" +
                     word + "\", with commas between them");
  return numbers;
}

} // namespace

const char *const flaw_allowed =
    "\"disc at X, Y, Z normal X, Y, Z radius R cut\", or \"plane at ... normal ... cut\", \"rectangle at ... "
    "normal "
    "... widths W, B cut\"; in place of cut also \"strength FACTOR\"";

std::optional<dem::Flaw> read_flaw(const std::string &text) {
  std::istringstream words(text);
  std::string first;
  if (!(words >> first)) return std::nullopt;
  std::vector<std::string> known;
  for (const FormRule &rule : forms)
    known.emplace_back(rule.word);
  const auto *const rule = forms + read_word(first, known);
  std::map<std::string, std::string> clauses = clauses_of(words);
  const auto take = [&](const std::string &word, std::size_t count, const char *unit, const Range &range) {
    const auto found = clauses.find(word);
    if (found == clauses.end()) throw ValueError("has no \"" + word + "\"");
    const std::string value = found->second;
    clauses.erase(found);
    return numbers_of(word, value, count, unit, range);
  };
  dem::Flaw flaw;
  flaw.form = rule->form;
  const std::vector<double> at = take("at", 3, "m", any_number()),
                            normal = take("normal", 3, "1", any_number());
  flaw.centre = {at[0], at[1], at[2]};
  flaw.normal = {normal[0], normal[1], normal[2]};
  const double size = norm(flaw.normal);
  if (!(size > 0)) throw ValueError("has a normal without a direction");
  flaw.normal = (1 / size) * flaw.normal;
  if (flaw.form == Form::disc) flaw.radius = take(rule->size, 1, "m", above(0)).front();
  if (flaw.form == Form::rectangle) {
    const std::vector<double> widths = take(rule->size, 2, "m", above(0));
    flaw.width = widths[0], flaw.breadth = widths[1];
  }
  if (const bool cut = clauses.count("cut") > 0; cut == (clauses.count("strength") > 0))
    throw ValueError("needs either \"cut\" or \"strength\" at its end");
  else if (!cut)
    flaw.strength_factor = take("strength", 1, "1", above_up_to(0, 1e3)).front();
  else if (const std::string rest = clauses.extract("cut").mapped(); !rest.empty())
    throw ValueError("has \"" + rest + "\" after cut");
  if (!clauses.empty())
    throw ValueError("has \"" + clauses.begin()->first + "\", which a " + rule->word + " has not");
  return flaw;
}

} // namespace platen::apps
