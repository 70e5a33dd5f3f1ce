#!/usr/bin/perl
# Checks the tables of doc/developers/walk.md and equations.md: every function that they name is in the file beside it,
# with its class; and what the text of walk.md names as `name` exists in the sources.
#   walk.pl DIRECTORY walk.md|equations.md
use strict;
use warnings;

my ($root, $page) = @ARGV;
die "usage: walk.pl DIRECTORY walk.md|equations.md\n" unless defined $page && $page =~ m{^(walk|equations)\.md$};
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

# | 13 | (what it is |) `Class::function` | `path` |
my %numbers;
while ($text =~ m{^\| (\d[\d, to]*) \|(?: [^|]* \|)? `(?:(\w+)::)?(\w+)` \| `(\S+)` \|$}mg)
{
  my ($row, $class, $function, $path) = ($1, $2, $3, $4);
  while ($row =~ m{(\d+)(?: to (\d+))?}g) { ++$numbers{$_} for $1 .. $2 // $1 }
  my $source = text_of($path);
  mistake("$row: $path has no function $function.") if $source !~ m{^ *(?:(?:\w+ )*\w+::|inline )?\Q$function\E\(}m;
  mistake("$row: $path has no $class.") if defined $class && $source !~ m{\b\Q$class\E\b};
}

if ($page eq 'walk.md')
{
  mistake("the parts of the table are " . join(' ', sort { $a <=> $b } keys %numbers) . ".")
    if join(' ', sort { $a <=> $b } keys %numbers) ne join(' ', 1 .. 10);
  my $all = '';
  for my $path (glob("$root/source/*/*.cc $root/include/debond/*/*.h")) { $all .= text_of(substr $path, 1 + length $root); }
  my ($parts) = $text =~ m{^(## 1\. .*)}ms;
  mistake("there is no part 1.") unless defined $parts;
  while (($parts // '') =~ m{`((?:\w+::)?\w+)`}g)
  {
    my ($class, $name) = $1 =~ m{^(?:(\w+)::)?(\w+)$};
    next if $all =~ m{\b\Q$name\E\b} && (!defined $class || $all =~ m{\b(?:class|struct) \Q$class\E\b});
    mistake("the sources have no $1.");
  }
}
else # from 1 to 50, which the paper has
{
  my @missing = grep { !$numbers{$_} } 1, 2, 8, 11 .. 14, 17 .. 20, 26, 28 .. 37, 49, 50;
  mistake("no row for @missing.") if @missing;
}
exit $wrong;
