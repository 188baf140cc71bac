#!/usr/bin/env bash
# rooms_test.sh LIST: arrows between rooms run one way. LIST has a line a room, in order: its name, its
# folder, its archive. No object may use a symbol that a later room defines, no file may include a
# header of one, and the objects of a room form no circle. What breaks this is printed with the two
# files and the name. Symbols are those that the linker sees; static functions are a file's own.
set -euo pipefail
list=${1:?usage: rooms_test.sh LIST, such as build/dev/tests/runner_rooms.txt}
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

# "def ROOM FILE SYMBOL" and "use ROOM FILE SYMBOL" of all objects
symbols() {
    local room folder archive
    while read -r room folder archive; do
        nm -A -P "$archive" | awk -v room="$room" -v folder="$folder" '{
            file = $1
            sub(/^.*\[/, "", file)
            sub(/\.o\]:$/, "", file)
            kind = $3 ~ /^[TDBRC]$/ ? "def" : $3 == "U" ? "use" : ""
            if (kind != "")
                print kind, room, folder "/" file, $2
        }'
    done <"$list"
}

# "inc ROOM FILE HEADER" of all includes, however they are written; a folder within a room is its
includes() {
    local room folder archive
    while read -r room folder archive; do
        { find "$root/$folder" -name '*.[ch]' -o -name '*.cpp' | xargs grep -HE '^ *# *include' || true; } |
            sed -E "s#^$root/([^:]+): *\# *include *[<\"]([^>\"]+)[>\"].*#inc $room \1 \2#"
    done <"$list"
}

{ awk '{ print "room", $1, $2 }' "$list"; symbols; includes; } | awk '
    $1 == "room" { order[$2] = ++rooms; folder = $3; sub(/^(runner|reports)\//, "", folder); at[folder] = $2; next }
    $1 == "def" { home[$4] = $3; room_of[$3] = $2; next }
    $1 == "use" { room_of[$3] = $2; uses[++count] = $3 " " $4; next }
    # The room whose folder a path lies in: the longest that is a part of it.
    function room_at(path) {
        while (!(path in at) && sub(/\/[^\/]*$/, "", path))
            ;
        return path in at ? at[path] : ""
    }
    $1 == "inc" {
        file = $3
        sub(/^(runner|reports)\//, "", file)
        from = room_at(file)
        header = $4
        gsub(/\.\.\//, "", header)
        sub(/^(runner|reports)\//, "", header)
        if (from == $2 && header ~ /^(devices\.h|record\/)/) {
            print $3 " includes " $4 ", which no room may: it is a program\047s"
            failed = 1
        }
        to = header ~ /\// ? room_at(header) : ""
        if (from == $2 && to != "" && order[to] > order[from]) {
            print $3 " includes " $4 " of room " to ", which stands above " from
            failed = 1
        }
    }
    END {
        for (i = 1; i <= count; i++) {
            split(uses[i], use, " ")
            from = use[1]
            to = home[use[2]]
            if (to == "" || to == from)
                continue
            if (order[room_of[to]] > order[room_of[from]]) {
                print from " uses " use[2] " of " to ": room " room_of[to] " stands above " room_of[from]
                failed = 1
            }
            if (room_of[to] == room_of[from] && !((from, to) in arrow)) {
                arrow[from, to] = use[2]
                out[from]++
            }
        }
        # Within a room: files that use none that is left are taken away; what stays is in a circle,
        # or above one.
        do {
            changed = 0
            for (pair in arrow) {
                split(pair, ends, SUBSEP)
                if (out[ends[2]] == 0) {
                    delete arrow[pair]
                    out[ends[1]]--
                    changed = 1
                }
            }
        } while (changed)
        # The same from above, so that only circles, and what joins two, stay.
        do {
            changed = 0
            for (file in into)
                delete into[file]
            for (pair in arrow) {
                split(pair, ends, SUBSEP)
                into[ends[2]]++
            }
            for (pair in arrow) {
                split(pair, ends, SUBSEP)
                if (into[ends[1]] == 0) {
                    delete arrow[pair]
                    changed = 1
                }
            }
        } while (changed)
        for (pair in arrow) {
            split(pair, ends, SUBSEP)
            print "circle: " ends[1] " uses " arrow[pair] " of " ends[2]
            failed = 1
        }
        if (rooms == 0 || count == 0) {
            print "nothing to check: " rooms " rooms, " count " uses"
            failed = 1
        }
        exit failed
    }'
