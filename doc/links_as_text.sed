#!/usr/bin/sed -Ef
# Of links to other pages, which are in the site, the pages of the source have the words.
s/\[([^]]*)\]\([^)]*\.md(#[^)]*)?\)/\1/g
