#!/usr/bin/perl
# Writes a source that compiles several tests at once: the headers of all, which take most of the time, and then each
# test NAME.cc in a namespace test_NAME of its own, in which its includes find their headers read already.
#   batch.pl NAME.cc... > BATCH.cc
use strict;
use warnings;

my (%seen, $tests);
for my $path (@ARGV)
{
  my ($name) = $path =~ m{(\w+)\.cc$} or die "batch.pl: $path is no test.\n";
  open my $file, '<', $path or die "batch.pl: $path: $!\n";
  print grep { m{^#include} && !$seen{$_}++ } <$file>;
  $tests .= "namespace test_$name\n{\n#include \"$path\"\n}\n";
}
print $tests;
