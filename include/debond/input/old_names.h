#ifndef debond_input_old_names_h
#define debond_input_old_names_h

#include <string>

namespace Debond
{
  /** What an entry of version 1 is called since version 2, "Interface / Normal
   *  stiffness"; empty if @p full_name was no entry that has another name. */
  std::string
  new_name_of(const std::string &full_name);

  /** What the value @p value of an entry with the name of version 2 is since
   *  then; the same if it has not changed. */
  std::string
  new_value_of(const std::string &full_name, const std::string &value);

  /** The text of a scene file of version 1 with the names, values and signs of
   *  version 2; comments stay. Files that it includes are read, to know its
   *  friction law, and are to be converted themselves. Throws InputError if it
   *  cannot be read. */
  std::string
  converted_scene(const std::string &filename);
} // namespace Debond
#endif
