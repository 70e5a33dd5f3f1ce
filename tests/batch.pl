#!/usr/bin/perl
# Writes a source that compiles several tests at once: the headers of all, which take most of the time, and then each
# test NAME.cc in a namespace test_NAME of its own. There its function main, which must be its last, is no longer special:
# it is given the return that it may lack.
#   batch.pl NAME.cc... > BATCH.cc
use strict;
use warnings;

my (%seen, @tests);
for my $path (@ARGV)
{
  my ($name) = $path =~ m{(\w+)\.cc$} or die "batch.pl: $path is no test.\n";
  open my $file, '<', $path or die "batch.pl: $path: $!\n";
  my @lines = <$file>;
  my ($last) = grep { $lines[$_] =~ m{^\}} } reverse 0 .. $#lines;
  $lines[$last] = "return 0; $lines[$last]";
  for (@lines)
  {
    next unless m{^#include};
    print unless $seen{$_}++;
    $_ = "\n";
  }
  push @tests, "namespace test_$name\n{\n#line 1 \"$path\"\n", @lines, "}\n";
}
print @tests;
