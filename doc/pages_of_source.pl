#!/usr/bin/perl -0777 -p
# Markdown for doxygen: formulas as it marks them, and of links to pages, which are in the site, the words.
s/(```.*?```|`[^`\n]*`)|\$\$(.*?)\$\$|\$([^\$]+?)\$/defined $1 ? $1 : defined $2 ? "\\f[$2\\f]" : "\\f\$$3\\f\$"/gse;
s/\[([^]]*)\]\([^)]*\.md(#[^)]*)?\)/$1/g;
