#include "errors/fields.hpp"

namespace temper::error_detail {
namespace {

bool asks_for(std::string_view word, const ErrorField& field) {
  if (word == "all") return field.group != FieldGroup::exact;
  return word == field.name || word == name(field.group);
}

/// `known_fields` begins the list of all in errors.
Expected<std::vector<Field>> select_fields(const std::vector<std::string>& names, std::span<const Field> all,
                                           std::string known_fields) {
  const std::vector<std::string> asked = names.empty() ? std::vector<std::string>{"all"} : names;
  std::vector<bool> wanted(all.size(), false);
  for (const std::string& word : asked) {
    bool known = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!asks_for(word, all[i].field)) continue;
      wanted[i] = known = true;
    }
    if (!known) {
      for (const Field& f : all) known_fields.append(", ").append(f.field.name);
      known_fields.insert(0, "no field '" + word + "'; ");
      return InputError{ErrorCode::invalid_option, "", known_fields};
    }
  }
  std::vector<Field> fields;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (wanted[i]) fields.push_back(all[i]);
  }
  return fields;
}

}  // namespace

Expected<std::vector<Field>> select_fields(const std::vector<std::string>& names, SpaceKind space) {
  constexpr const char* kGroups[] = {"the fields are all, chosen, held-back, exact",
                                     "the fields on the sphere are all, chosen, held-back",
                                     "the fields in a periodic plane are all, chosen, held-back"};
  return select_fields(names, all_fields(space), kGroups[static_cast<std::size_t>(space)]);
}

Expected<std::vector<Field>> select_fields_of_space(const std::vector<std::string>& names) {
  return select_fields(names, fields_of_space(),
                       "the fields of tetrahedra and curved surfaces are all, chosen, held-back, exact");
}

}  // namespace temper::error_detail
