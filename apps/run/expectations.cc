#include "apps/run/expectations.h"

#include <string>

#include "apps/scene/errors.h"
#include "apps/scene/expect.h"

namespace platen::apps {

int tell_expectations(const Scene &scene, const nlohmann::ordered_json &summary, RunLog &log) {
  const ExpectationCheck check = check_expectations(scene, summary);
  for (const std::string &line : check.failed)
    log.error("expected: {}", line);
  std::string keys;
  for (const std::string &key : check.unchecked)
    keys += (keys.empty() ? "" : ", ") + key;
  if (!keys.empty()) log.info("expected, but measured by another app and not checked here: {}", keys);
  return check.failed.empty() ? status_done : status_check_failed;
}

} // namespace platen::apps
