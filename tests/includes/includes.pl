#!/usr/bin/perl
# Checks the includes of the sources, and what doc/developers/source.md and source.csv say of the folders, and prints
# everything that is wrong.
#   includes.pl DIRECTORY ROOM...
# DIRECTORY holds source/ROOM, include/debond/ROOM, source/main.cc and doc/developers. A file may include headers of its
# own room and of those named before it, main.cc those of any. A header and a source of the same name, taken together,
# must not need themselves through others. The table of source.md has a row for each room, in the same order; source.csv
# has a row for each file, without suffix: room, file, content.
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

# The table: | `room` | text |
my ($in_section, @rows, %named);
for (lines_of('doc/developers/source.md'))
{
  $in_section = m{^## Folders in order} if m{^## };
  push @rows, $1 if $in_section && m{^\| `(\w+)` \|};
}
push @mistakes, "doc/developers/source.md: the folders of the table are @rows, those of the sources @rooms."
  if "@rows" ne "@rooms";

# The files: room,file,content
for (lines_of('doc/developers/source.csv'))
{
  next if m{^folder,file,content$};
  if (m{^(\w+),(\w+),\S}) { $named{$1}{$2} = 1 }
  else { push @mistakes, "doc/developers/source.csv: no row of folder, file and content: $_" =~ s{\n}{}r }
}
for my $room (@rooms)
{
  push @mistakes, "doc/developers/source.csv: there is no row for $_ of $room." for grep { !$named{$room}{$_} } sort keys %{$files{$room}};
  push @mistakes, "doc/developers/source.csv: $room holds no $_." for grep { !$files{$room}{$_} } sort keys %{$named{$room}};
  delete $named{$room};
}
push @mistakes, "doc/developers/source.csv: there is no folder $_." for sort keys %named;

print "$_\n" for @mistakes;
exit(@mistakes ? 1 : 0);
