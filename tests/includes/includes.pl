#!/usr/bin/perl
# Checks the includes of the sources and the table of rooms in doc/solution.md, and prints everything that is wrong.
#   includes.pl DIRECTORY ROOM...
# DIRECTORY holds source/ROOM, include/debond/ROOM, source/main.cc and doc/solution.md. A file may include headers of its
# own room and of those named before it, main.cc those of any. A header and a source of the same name, taken together,
# must not need themselves through others. In the table each room has a row, in the same order, which names the files of
# the room, without suffix, and nothing else, in backticks; `*_x` names all that end so.
use strict;
use warnings;

my ($directory, @rooms) = @ARGV;
die "usage: includes.pl DIRECTORY ROOM...\n" unless @rooms;
chdir $directory or die "includes.pl: $directory: $!\n";
my %rank = map { $rooms[$_] => $_ } 0 .. $#rooms;
my (@mistakes, %needs, %files);

sub lines_of
{
  my ($path) = @_;
  open my $file, '<', $path or die "includes.pl: $path: $!\n";
  return <$file>;
}

# Every include line of the sources.
for my $path (sort glob("source/*/* source/*.* include/debond/*/* include/debond/*.*"))
{
  next if $path =~ m{\.(txt|cmake)$} || -d $path; # of the build
  my ($room, $name) = $path =~ m{^(?:source|include/debond)/(\w+)/(\w+)\.(?:cc|h)$};
  my $is_main = $path eq 'source/main.cc';
  if (!$is_main && (!defined $room || !exists $rank{$room}))
  {
    push @mistakes, "$path: is in none of the rooms @rooms.";
    next;
  }
  $files{$room}{$name} = 1 unless $is_main;
  my $line = 0;
  for (lines_of($path))
  {
    ++$line;
    next unless m{^\s*#\s*include\s*[<"]([^>"]+)[>"]};
    my $header = $1;
    if (!m{<} || ($header =~ m{^debond/} && !-e "include/$header"))
    {
      push @mistakes, "$path:$line: $header is no header of include/debond/ROOM or of the system.";
      next;
    }
    next unless $header =~ m{^debond/(\w+)/};
    my $of = $1;
    push @{$needs{"$room/$name"}}, $header =~ m{^debond/(.*)\.h$} if !$is_main;
    push @mistakes, "$path:$line: $room may not include $header."
      if !$is_main && exists $rank{$of} && $rank{$of} > $rank{$room};
  }
}

# Circles: a file is left behind once all that it needs have been.
my (%state, @way);
sub visit
{
  my ($file) = @_;
  if (($state{$file} // '') eq 'on the way')
  {
    my ($first) = grep { $way[$_] eq $file } 0 .. $#way;
    push @mistakes, 'a circle: ' . join(' -> ', @way[$first .. $#way], $file);
  }
  return if $state{$file};
  $state{$file} = 'on the way';
  push @way, $file;
  visit($_) for grep { $_ ne $file } @{$needs{$file} // []};
  pop @way;
  $state{$file} = 'done';
}
visit($_) for sort keys %needs;

# The table: | `room` | text with `files` |
my ($in_section, @rows, %named);
for (lines_of('doc/solution.md'))
{
  $in_section = m{^## The rooms of the source} if m{^## };
  next unless $in_section && m{^\| `(\w+)` \|(.*)};
  my ($room, $text) = ($1, $2);
  push @rows, $room;
  for my $name ($text =~ m{`([\w*]+)`}g)
  {
    my $pattern = $name =~ s{\*}{\\w*}gr;
    my @meant = $name =~ m{\*} ? grep { m{^$pattern$} } keys %{$files{$room}} : ();
    $named{$room}{$_} = 1 for @meant ? @meant : $name;
  }
}
push @mistakes, "doc/solution.md: the rooms of the table are @rows, those of the sources @rooms." if "@rows" ne "@rooms";
for my $room (@rooms)
{
  push @mistakes, "doc/solution.md: the row of $room lacks $_." for grep { !$named{$room}{$_} } sort keys %{$files{$room}};
  push @mistakes, "doc/solution.md: $room holds no $_." for grep { !$files{$room}{$_} } sort keys %{$named{$room}};
}

print "$_\n" for @mistakes;
exit(@mistakes ? 1 : 0);
