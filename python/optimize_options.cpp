#include "optimize_options.hpp"

namespace temper::python {
namespace {

/// Choices that are numbers for Python users: star=1.
bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

py::object choice_to_python(std::string_view name) {
  const py::str text(name.data(), name.size());
  return is_number(name) ? py::object(py::int_(text)) : py::object(text);
}

py::object value_to_python(const OptionValue& value) {
  return std::visit(
      [&](const auto& v) -> py::object {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::monostate>) {
          return py::none();
        } else if constexpr (std::is_same_v<T, std::int64_t>) {
          return py::int_(v);
        } else if constexpr (std::is_same_v<T, std::string_view>) {
          return choice_to_python(v);
        } else {
          return to_python(v);
        }
      },
      value);
}

/// Throws py::cast_error if the type is wrong. `text` keeps the name of a choice.
OptionValue value_from_python(const OptionRow& row, const py::handle& value, std::string& text) {
  if (value.is_none()) return {};
  switch (row.kind) {
    case OptionKind::count:
      return value.cast<std::int64_t>();
    case OptionKind::number:
      return value.cast<double>();
    case OptionKind::choice:
      text = py::isinstance<py::int_>(value) ? py::str(value).cast<std::string>() : value.cast<std::string>();
      return std::string_view(text);
    case OptionKind::length_parameter:
      return length_parameter_from(value);
    case OptionKind::vertex: {
      const auto number = value.cast<std::int64_t>();
      return number < 0 ? OptionValue(number) : OptionValue(VertexId(static_cast<std::size_t>(number)));
    }
  }
  return {};
}

std::string quoted(std::string_view choice) {
  return is_number(choice) ? std::string(choice) : "\"" + std::string(choice) + "\"";
}

/// The type of an option, as in a stub.
std::string type_of(const OptionRow& row) {
  const auto plain = [&]() -> std::string {
    switch (row.kind) {
      case OptionKind::number:
        return "float";
      case OptionKind::length_parameter:
        return "LengthParameterLike";
      case OptionKind::choice: {
        std::string list;
        for (const std::string_view choice : row.choices) list += (list.empty() ? "" : ", ") + quoted(choice);
        return "Literal[" + list + "]";
      }
      default:
        return "int";
    }
  };
  return plain() + (row.optional ? " | None" : "");
}

}  // namespace

std::string spelled(std::string_view text) {
  return spell_options(text, [](const OptionRow& row, std::string_view value) {
    const std::string name(row.name);
    if (value.empty()) return name;
    return name + "=" + (row.kind == OptionKind::choice ? quoted(value) : std::string(value));
  });
}

OptimizeOptions options_from(const py::dict& dict) {
  OptimizeOptions options;
  for (const auto& [key, value] : dict) {
    const auto name = key.cast<std::string>();
    const OptionRow* row = find_option(name);
    if (row == nullptr) throw py::type_error("there is no option " + name);
    std::string text;
    try {
      const OptionValue given = value_from_python(*row, value, text);
      or_raise(check_option(*row, given));
      row->set(options, given);
    } catch (const py::cast_error&) {
      throw py::type_error(name + ": expected " + type_of(*row) + ", found " + py::repr(value).cast<std::string>());
    }
  }
  return options;
}

py::dict options_to_dict(const OptimizeOptions& options) {
  py::dict dict;
  for (const OptionRow& row : option_rows()) {
    dict[py::str(std::string(row.name))] = value_to_python(row.get(options));
  }
  return dict;
}

py::list option_table() {
  py::list table;
  for (const OptionGroup& group : option_groups()) {
    for (const OptionRow& row : group.rows) {
      py::list choices;
      for (const std::string_view choice : row.choices) choices.append(choice_to_python(choice));
      table.append(Record()("name", row.name)("group", group.title)("sentence", spelled(row.sentence))(
                       "type", type_of(row))("choices", py::object(choices))("range", option_range_text(row))(
                       "absent", spelled(row.absent))("default", value_to_python(row.get({})))
                       .dict);
    }
  }
  return table;
}

py::list idle_options(const py::dict& given, const py::list& names) {
  const OptimizeOptions options = options_from(given);
  py::list sentences;
  for (const py::handle& item : names) {
    const auto name = item.cast<std::string>();
    const OptionRow* row = find_option(name);
    const std::string missing = missing_need(*row, options);
    if (missing.empty() || row->get(options) == row->get({})) continue;
    sentences.append(name + " has no effect without " + spelled(missing));
  }
  return sentences;
}

}  // namespace temper::python
