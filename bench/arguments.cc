#include "arguments.h"

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <type_traits>

namespace platen::bench {

void read_arguments(int argc, char **argv, const char *title, const std::vector<Argument> &arguments) {
  CLI::App app{title};
  for (const Argument &a : arguments)
    std::visit(
        [&](auto *value) {
          using Value = std::remove_pointer_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, bool>) {
            app.add_flag(a.name, *value, a.meaning);
          } else {
            CLI::Option *option = app.add_option(a.name, *value, a.meaning)->capture_default_str();
            if constexpr (!std::is_same_v<Value, std::string>)
              option->check(CLI::Range(a.low, a.high));
            else if (a.is_file)
              option->check(CLI::ExistingFile);
            else if (!a.words.empty())
              option->check(CLI::IsMember(a.words));
          }
        },
        a.value);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &e) {
    std::exit(app.exit(e));
  }
}

} // namespace platen::bench
