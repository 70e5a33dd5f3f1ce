#include <debond/input/entry_table.h>
#include <debond/shapes/body_parameters.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <string>
#include <vector>

namespace Debond
{
  // A lattice is given by its numbers of cells, what is fitted by a word and
  // those of its parts.
  void
  BodyParameters::declare_cells(EntryTable        &table,
                                const bool         is_bone,
                                const std::string &description)
  {
    const AllowedValues allowed_cells = Allowed::whole_number(1, 1000000000);
    static const std::string word     = "fitted";
    const unsigned int       n_parts  = is_bone ? 4 : 3;
    const AllowedValues      of_fitted =
                          Allowed::list(allowed_cells, n_parts, n_parts),
                        of_lattice =
                          Allowed::list(allowed_cells, is_bone ? 3 : 2, 3);
    const auto rest_of = [](const std::string &text) {
      return boost::trim_copy(text.substr(word.size()));
    };
    const auto is_word = [](const std::string &text) {
      return text == word || boost::starts_with(text, word + " ");
    };
    AllowedValues allowed = of_lattice;
    allowed.test          = [=](const std::string &text) {
      return is_word(text) ?
                        rest_of(text).empty() || of_fitted.test(rest_of(text)) :
                        of_lattice.test(text);
    };
    allowed.description +=
      ", or fitted, alone or with " + std::to_string(n_parts) + " of them";
    allowed.hint = [=](const std::string &text) {
      return is_word(text) ? "" : of_lattice.hint(text);
    };
    allowed = allowed.or_word_for("auto", is_bone ? "15, 15, 2" : "3, 2");
    const auto set = [=](const std::string &entry) {
      const std::string text = allowed.without_words(entry);
      fitted_cells           = {{0, 0, 0}};
      std::vector<unsigned int> numbers;
      if (!is_word(text))
        {
          read_entry(text, numbers);
          cells = {
            {numbers.front(), numbers[numbers.size() - 2], numbers.back()}};
          return;
        }
      if (rest_of(text).empty())
        numbers = is_bone ? std::vector<unsigned int>{16, 6, 10, 9} :
                            std::vector<unsigned int>{12, 5, 5};
      else
        read_entry(rest_of(text), numbers);
      fitted_cells = {{numbers[0], numbers[1], is_bone ? numbers[2] : 0}};
      cells[2]     = numbers.back(); // take_rim() has the others
    };
    std::vector<unsigned int> numbers{cells.begin(), cells.end()};
    if (is_fitted())
      {
        numbers.assign(fitted_cells.begin(),
                       fitted_cells.begin() + n_parts - 1);
        numbers.push_back(cells[2]);
      }
    else if (!is_bone && cells[0] == cells[1])
      numbers.erase(numbers.begin());
    table.add("Cells",
              allowed.in_words((is_fitted() ? word + " " : "") +
                               entry_text(numbers)),
              set,
              allowed,
              description);
  }
} // namespace Debond
