#!/usr/bin/perl
# Checks doc/developers/walk.md, point.md and equations.md: every function that they name with a file, `function` (`path`)
# in the first two and in a row of the table of equations.md, is there, with its class; each part of the first two names one;
# and what these parts name as `name` exists in the sources.
#   walk.pl DIRECTORY walk.md|point.md|equations.md
use strict;
use warnings;

my ($root, $page) = @ARGV;
die "usage: walk.pl DIRECTORY walk.md|point.md|equations.md\n" unless defined $page && $page =~ m{^(walk|point|equations)\.md$};
my $wrong = 0;
sub mistake
{
  print "doc/developers/$page: @_\n";
  $wrong = 1;
}
sub text_of
{
  my ($path) = @_;
  open my $file, '<', "$root/$path" or do { mistake("there is no $path."); return '' };
  local $/;
  return scalar <$file>;
}
my $text = text_of("doc/developers/$page");

sub check_function
{
  my ($place, $name, $path) = @_;
  my ($class, $function) = $name =~ m{^(?:(\w+)::)?(\w+)$};
  my $source = text_of($path);
  mistake("$place: $path has no function $function.") if $source !~ m{^ *(?:(?:\w+ )*\w+::|inline )?\Q$function\E\(}m;
  mistake("$place: $path has no $class.") if defined $class && $source !~ m{\b\Q$class\E\b};
}

if ($page ne 'equations.md')
{
  my @parts = $text =~ m{^(## .*?)(?=^## |\z)}msg;
  my $all = '';
  for my $path (glob("$root/source/*/*.cc $root/include/debond/*/*.h")) { $all .= text_of(substr $path, 1 + length $root); }
  for my $n (1 .. ($page eq 'walk.md' ? 8 : 6))
  {
    my ($part) = grep { m{^## $n\. } } @parts;
    if (!defined $part) { mistake("there is no part $n."); next; }
    my @pairs = $part =~ m{`([\w:]+)`\s\(`(\S+)`\)}g;
    mistake("part $n names no function with its file.") unless @pairs;
    while (my ($name, $path) = splice @pairs, 0, 2) { check_function("part $n", $name, $path); }
    while ($part =~ m{`(?:(\w+)::)?(\w+)`}g)
    {
      my ($class, $name) = ($1, $2);
      next if $all =~ m{\b\Q$name\E\b} && (!defined $class || $all =~ m{\b(?:class|struct) \Q$class\E\b});
      mistake("part $n: the sources have no " . (defined $class ? "$class\::" : '') . "$name.");
    }
  }
}
else
{
  # | 13 | what it is | `Class::function` | `path` |; from 1 to 50, which the paper has
  my %numbers;
  while ($text =~ m{^\| (\d[\d, to]*) \| [^|]* \| `([\w:]+)` \| `(\S+)` \|$}mg)
  {
    my ($row, $name, $path) = ($1, $2, $3);
    while ($row =~ m{(\d+)(?: to (\d+))?}g) { ++$numbers{$_} for $1 .. $2 // $1 }
    check_function($row, $name, ($path =~ m{\.h$} ? 'include/debond/' : 'source/') . $path);
  }
  my @missing = grep { !$numbers{$_} } 1, 2, 8, 11 .. 14, 17 .. 20, 26, 28 .. 37, 49, 50;
  mistake("no row for @missing.") if @missing;
}
exit $wrong;
