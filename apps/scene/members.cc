#include "apps/scene/members.h"

namespace platen::apps {
namespace {

template <class Parameters>
bool has(const std::string &member) {
  bool found = false;
  const Parameters empty{};
  Parameters::describe([&](const char *name, const auto &...) { found = found || name == member; }, empty);
  return found;
}

} // namespace

std::string key_of(const std::string &member) {
  std::string key = member;
  std::replace(key.begin(), key.end(), '_', ' ');
  if (!key.empty() && key[0] >= 'a' && key[0] <= 'z') key[0] = static_cast<char>(key[0] - 'a' + 'A');
  return key;
}

Declared LawMembers::operator()(const std::string &member) {
  const std::string key = key_of(member);
  section_.join(true);
  std::apply([&](auto &...of) { (declare_member(section_, of, member, key), ...); }, laws_);
  section_.join(false);
  const std::vector<std::string> having = dem::BondLaws::words_where(
      [&](auto *law) { return has<typename std::remove_pointer_t<decltype(law)>::Parameters>(member); });
  Declared declared = section_.at(key);
  if (having.size() == dem::BondLaws::size) return declared.unless("Effects/Bond", {"none"});
  declared.only_if("Effects/Bond", having);
  return section_.name() == "Effects" ? declared : declared.remark(joined(having)); // said already
}

void LawMembers::rest() {
  std::vector<std::string> names;
  const auto take = [&](const char *name, const auto &value, const auto &...) {
    if (!std::is_same_v<std::decay_t<decltype(value)>, bool>) names.emplace_back(name);
  };
  std::apply([&](auto &...of) { (std::decay_t<decltype(of)>::describe(take, of), ...); }, laws_);
  for (const std::string &member : names)
    if (section_.parameters().find(section_.name() + "/" + key_of(member)) == nullptr) (*this)(member);
}

} // namespace platen::apps
