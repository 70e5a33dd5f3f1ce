#include <debond/input/special_characters.h>

#include <boost/regex/pending/unicode_iterator.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

namespace Debond
{
  namespace
  {
    struct SpecialCharacter
    {
      std::uint32_t code;
      const char   *name;
      const char   *plain; ///< in an expression; empty: nothing like it
    };

    constexpr const char *quote = "a typographic quote";

    const std::array<SpecialCharacter, 46> known_characters{
      {{0x00A0, "a blank that does not break", "a plain blank"},
       {0x00AB, quote, ""},
       {0x00AD, "a hyphen that is not seen", "-"},
       {0x00B0, "a degree sign", ""},
       {0x00B2, "a raised 2", "^2"},
       {0x00B3, "a raised 3", "^3"},
       {0x00B4, "an accent", ""},
       {0x00B5, "a micro sign", ""},
       {0x00B7, "a raised dot", "*"},
       {0x00BB, quote, ""},
       {0x00BD, "one half in one character", "0.5"},
       {0x00D7, "a multiplication sign", "*"},
       {0x00F7, "a division sign", "/"},
       {0x03BC, "a Greek mu", ""},
       {0x03C0, "a Greek pi", "pi"},
       {0x2007, "a blank that does not break", "a plain blank"},
       {0x2009, "a thin blank", "a plain blank"},
       {0x200B, "a blank without width", "nothing"},
       {0x2010, "a typographic hyphen", "-"},
       {0x2011, "a typographic hyphen", "-"},
       {0x2012, "a dash", "-"},
       {0x2013, "an en dash", "-"},
       {0x2014, "an em dash", "-"},
       {0x2018, quote, ""},
       {0x2019, quote, ""},
       {0x201A, quote, ""},
       {0x201C, quote, ""},
       {0x201D, quote, ""},
       {0x201E, quote, ""},
       {0x202F, "a narrow blank that does not break", "a plain blank"},
       {0x2039, quote, ""},
       {0x203A, quote, ""},
       {0x2044, "a fraction slash", "/"},
       {0x2060, "a joint without width", "nothing"},
       {0x2212, "a typographic minus", "-"},
       {0x2215, "a division slash", "/"},
       {0x221A, "a square root", "sqrt()"},
       {0x22C5, "a raised dot", "*"},
       {0x2260, "a sign for unequal", "!="},
       {0x2264, "a sign for less or equal", "<="},
       {0x2265, "a sign for greater or equal", ">="},
       {0xFB00, "the letters ff in one character", ""},
       {0xFB01, "the letters fi in one character", ""},
       {0xFB02, "the letters fl in one character", ""},
       {0xFB03, "the letters ffi in one character", ""},
       {0xFEFF, "a blank without width", "nothing"}}};



    const SpecialCharacter *
    known_character(const std::uint32_t code)
    {
      for (const SpecialCharacter &character : known_characters)
        if (character.code == code)
          return &character;
      return nullptr;
    }



    /** The code of the UTF-8 character that begins at @p position, which is
     *  moved behind it; 0, and moved by one byte, if none begins there. */
    std::uint32_t
    next_code(const std::string &text, std::string::size_type &position)
    {
      using Characters = boost::u8_to_u32_iterator<std::string::const_iterator>;
      try
        {
          Characters          character(text.begin() + position,
                               text.begin() + position,
                               text.end());
          const std::uint32_t code = *character;
          position                 = (++character).base() - text.begin();
          return code;
        }
      catch (const std::out_of_range &)
        {
          ++position;
          return 0;
        }
    }
  } // namespace



  std::string
  remark_on_special_character(const std::string &text, const bool in_expression)
  {
    const auto special =
      std::find_if(text.begin(), text.end(), [](const unsigned char c) {
        return c > 127;
      });
    if (special == text.end())
      return "";
    std::string::size_type position = special - text.begin();
    const std::uint32_t    code     = next_code(text, position);
    char                   number[16];
    if (code == 0)
      {
        const auto byte = static_cast<unsigned char>(*special);
        std::snprintf(number, sizeof number, "%02X", byte);
        return std::string("; there is a byte ") + number +
               " in it, which is no character of UTF-8";
      }
    std::snprintf(number, sizeof number, "U+%04X", code);
    const std::string beginning =
      std::string("; there is a special character in it: ") + number;
    const SpecialCharacter *const known = known_character(code);
    if (known == nullptr)
      return beginning;
    const std::string plain = in_expression ? known->plain : "";
    return beginning + ", " + known->name +
           (plain.empty() ? "" : ": write " + plain);
  }



  bool
  has_quotes(const std::string &text)
  {
    if (text.find_first_of("\"'`") != std::string::npos)
      return true;
    for (std::string::size_type position = 0; position < text.size();)
      {
        const SpecialCharacter *const known =
          known_character(next_code(text, position));
        if (known != nullptr && known->name == quote)
          return true;
      }
    return false;
  }
} // namespace Debond
