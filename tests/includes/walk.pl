#!/usr/bin/perl
# Checks doc/walk.md: every function that its table names is defined in the file beside it, and what its text names as
# `name` exists in the sources.
#   walk.pl DIRECTORY
use strict;
use warnings;

my $root = shift or die "usage: walk.pl DIRECTORY\n";
sub text_of
{
  my ($path) = @_;
  open my $file, '<', $path or do { print "doc/walk.md: there is no $path.\n"; exit 1 };
  local $/;
  return scalar <$file>;
}
my $walk = text_of("$root/doc/walk.md");
my $wrong = 0;
my $stations = 0;
while ($walk =~ m{^\| (\d+) \| `([\w:]+)` \| \[(\S+)\]\(\.\./\3\) \|$}mg)
{
  my ($station, $function, $path) = ($1, $2, $3);
  ++$stations;
  next if text_of("$root/$path") =~ m{^  \Q$function\E\(}m;
  print "doc/walk.md: station $station: $path defines no $function.\n";
  $wrong = 1;
}
my $all = '';
for my $path (glob("$root/source/*/*.cc $root/include/debond/*/*.h")) { $all .= text_of($path); }
my ($text) = $walk =~ m{(\*\*1\..*)}s;
while ($text =~ m{`((?:\w+::)?\w+)`}g)
{
  my ($class, $name) = $1 =~ m{^(?:(\w+)::)?(\w+)$};
  next if $name =~ m{\.csv$};
  next if $all =~ m{\b\Q$name\E\b} && (!defined $class || $all =~ m{\b(class|struct) \Q$class\E\b});
  print "doc/walk.md: the sources have no $1.\n";
  $wrong = 1;
}
if ($stations != 10) { print "doc/walk.md: $stations stations.\n"; $wrong = 1; }
exit $wrong;
