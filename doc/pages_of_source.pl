#!/usr/bin/perl -0777 -p
# Markdown of developers/ for doxygen: formulas as it marks them, and links to pages as links into the site beside its pages.
s/(```.*?```|`[^`\n]*`)|\$\$(.*?)\$\$|\$([^\$]+?)\$/defined $1 ? $1 : defined $2 ? "\\f[$2\\f]" : "\\f\$$3\\f\$"/gse;
s{\[([^]]*)\]\(([\w/.]*)\.md(#[^)]*)?\)}{my ($text, $page, $anchor) = ($1, $2, $3 // '');
  $page = "developers/$page" unless $page =~ s{^\.\./}{};
  qq(<a href="../site/$page.html$anchor">$text</a>)}gse;
