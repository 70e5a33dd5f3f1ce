#!/usr/bin/perl
# Prints what would read or write numbers, or compare letters, in the locale of the program that uses the library.
#   locale.pl DIRECTORY
# Streams are Classic (number_text.h), other numbers are read and written by from_chars and to_chars, and functions of
# letters are told the classic locale.
use strict;
use warnings;

chdir $ARGV[0] or die "locale.pl: $ARGV[0]: $!\n";
my $failed = 0;
for my $path (sort glob("source/*.cc source/*/*.cc include/debond/*/*.h python/*.cc"))
{
  open my $file, '<', $path or die "locale.pl: $path: $!\n";
  local $/;
  my $text = <$file>;
  $text =~ s{//[^\n]*|/\*.*?\*/}{my $comment = $&; $comment =~ s/[^\n]//g; $comment}gse;
  my @mistakes;
  push @mistakes, [$-[0], $1] while $text =~ m{(std::[io]?(?:string|f)stream)\b(?!\s*[>&])}g;
  push @mistakes, [$-[0], $1] while $text =~ m{\b(strto[dfl]+|sto(?:d|f|ld)|ato[fl]|v?s?n?(?:print|scan)f|lexical_cast|string_to_double)\s*[(<](?!')}g;
  push @mistakes, [$-[0], $1] while $text =~ m{\b((?:to_(?:lower|upper)(?:_copy)?|i(?:equals|contains|starts_with|ends_with)|std::(?:to(?:lower|upper)|is(?:alpha|alnum|digit|lower|punct|space|upper)))\((?![^;]*locale::classic)[^;]*)}g;
  for (sort { $a->[0] <=> $b->[0] } @mistakes)
  {
    my $line = 1 + (substr($text, 0, $_->[0]) =~ tr/\n//);
    print "$path:$line: $_->[1]\n";
    $failed = 1;
  }
}
exit $failed;
