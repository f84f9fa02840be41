/* The binary radix tree over sorted codes, each inner node by itself (T. Karras 2012, "Maximizing Parallelism in the
 * Construction of BVHs, Octrees, and k-d Trees", section 4). */
#include "passes/light_tree_links.glsl"

/* Leading bits that two codes share; -1 past either end. */
int shared_bits(int i, int j)
{
    if (j < 0 || j >= int(tree.live))
        return -1;
    uvec2 differ = codes[i] ^ codes[j];
    return differ.x != 0u ? 31 - findMSB(differ.x) : 63 - findMSB(differ.y);
}

/* The other end of the run of codes that node i, one of its ends, is over. */
int other_end(int i, int direction)
{
    int least = shared_bits(i, i - direction);
    int bound = 2;
    while (shared_bits(i, i + bound * direction) > least)
        bound *= 2;
    int length = 0;
    for (int reach = bound / 2; reach > 0; reach /= 2)
        if (shared_bits(i, i + (length + reach) * direction) > least)
            length += reach;
    return i + length * direction;
}

/* The last code of the first half: those that share more bits with the first than the last does. */
int split(int first, int last)
{
    int all = shared_bits(first, last);
    int low = first, high = last;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (shared_bits(first, middle) > all)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The link to what is over the codes from one place to another, `edge` the one at which it stands. */
uint link_to(int edge, bool alone, uint parent)
{
    parents[alone ? record_count + uint(edge) : uint(edge)] = parent;
    return alone ? LSF_LIGHT_TREE_LEAF | (codes[edge].y & CODE_ID_MASK) : uint(edge);
}

void main()
{
    uint node = gl_GlobalInvocationID.x;
    if (node == 0u)
        tree.root = tree.live > 1u ? 0u
                    : tree.live == 1u ? LSF_LIGHT_TREE_LEAF | (codes[0].y & CODE_ID_MASK)
                                      : LSF_LIGHT_TREE_NONE;
    if (node + 1u >= tree.live)
        return;
    int i = int(node);
    int direction = shared_bits(i, i + 1) > shared_bits(i, i - 1) ? 1 : -1;
    int j = other_end(i, direction);
    int first = min(i, j), last = max(i, j), middle = split(first, last);
    nodes[node].left = link_to(middle, middle == first, node);
    nodes[node].right = link_to(middle + 1, middle + 1 == last, node);
    nodes[node].count = uint(last - first + 1);
    parents[place_of_visits(node)] = 0u;
}
